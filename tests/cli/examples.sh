# What the examples of the helps suppose to be there. Beside map.pmp and q.pmq, of the built-in scene and small.
set -e
# scenes/cornell-diffuse.obj is the built-in scene, so that all streams are of one.
mkdir small out scripts

# Programs of the same names that make little, unless told how much. They stand before the others in the path.
cat > small/pm-queries <<'END'
#!/bin/sh
case " $* " in *" --only-tiles "*) exec "$PROGRAMS/pm-queries" "$@" ;; esac
sized=
for word; do
    shift
    case $word in 512x512) word=32x32 ;; --size) sized=yes ;; esac
    set -- "$@" "$word"
done
[ $sized ] || set -- "$@" --size 32x32
exec "$PROGRAMS/pm-queries" "$@" --gathers 4
END
printf '%s\n' '#!/bin/sh' 'exec "$PROGRAMS/pm-sample" $(echo " $* " | sed "s/ 25000 / 500 /; s/ 250 / 50 /; s/ --batches 16 / --batches 2 /")' > small/pm-sample
printf '%s\n' '#!/bin/sh' 'exec "$PROGRAMS/pm-picture" "$@" --size 8x8 -n 2000 --caustics 1000' > small/pm-picture
printf '%s\n' '#!/bin/sh' 'exec "$PROGRAMS/pm-plan" $(echo " $* " | sed "s/ --error [0-9]*% / --error 80% /") --size 8x8 --pixels 16 --pilot-photons 5000' > small/pm-plan
chmod +x small/*

cp scenes/cornell-diffuse.obj room.obj
cp scenes/cornell.mtl .
pm-reorder hilbert q.pmq -o hilbert.pmq
cp q.pmq queries.pmq
pm-gather map.pmp q.pmq -o trace.pmt
cp trace.pmt scanline.pmt
pm-gather map.pmp hilbert.pmq -o hilbert.pmt
cp map.pmp hilbert.pmq hilbert.pmt out/
pm-cachesim --ways 1,2,full --format csv scanline.pmt hilbert.pmt > ways.csv
cp ways.csv orders.csv
printf 'x,y,z,power_r,power_g,power_b\n0,0,0,1,1,1\n' > photons.csv
printf 'title = "T"\n[[section]]\nheading = "H"\ntext = "x"\n' > report.toml
printf 'point,gather\na,-k 5\n' > my.csv
mkdir out/my
cp ways.csv out/my/a.csv
printf 'label,word,stage,text\n' > scripts/words.csv
