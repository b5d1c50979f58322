.option norvc
_start:
  li   s0, 1
  slli s0, s0, 31
  li   s1, 0x10000
  add  s0, s0, s1      # 0x80010000, data
  mv   s1, s0
  li   s2, 200
  li   t3, 0
loop:
  ld   t0, 0(s1)
  add  t0, t0, s2
  sd   t0, 8(s1)
  lw   t1, 4(s1)
  sw   t1, 20(s1)
  lh   t1, 2(s1)
  lhu  t1, 6(s1)
  sh   t1, 30(s1)
  lb   t1, 1(s1)
  lbu  t1, 3(s1)
  sb   t1, 33(s1)
  lwu  t1, 40(s1)
  addi t2, s1, 48
  amoadd.d t1, s2, (t2)
  amoswap.w t1, s2, (t2)
  lr.d t1, (t2)
  sc.d t1, s2, (t2)
.option rvc
  c.ld a0, 0(s1)
  c.sd a0, 16(s1)
  c.lw a1, 24(s1)
  c.sw a1, 28(s1)
.option norvc
  addi s1, s1, 72
  addi t3, t3, 1
  li   t4, 60
  bne  t3, t4, skip
  mv   s1, s0
  li   t3, 0
skip:
  addi s2, s2, -1
  bnez s2, loop
  li   t5, 1
  slli t5, t5, 31
  li   t6, 0x1000
  add  t5, t5, t6      # 0x80001000, tohost
  li   t6, 1
end:
  sd   t6, 0(t5)
  j    end
