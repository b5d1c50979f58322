# make bench: speed, as ratios measured side by side in one run. The peers are built by nothing else.

TAKEN += bench
PEERS := --release --manifest-path tests/peers/Cargo.toml
BENCH_PHOTONS := out/bench/450000.pmp out/bench/100000.pmp
BENCH_QUERIES := out/bench/hilbert.pmq out/bench/scanline.pmq out/bench/random.pmq
# How many photons are looked for, and within which distance.
BENCH_AIMS := 10,50,100,500,100@0.01

bench: $(BENCH_PHOTONS) $(BENCH_QUERIES) ## Speed, as ratios measured side by side, to other libraries as well: five minutes
	$(CARGO) bench -p pm-programs
	RUSTFLAGS='-C target-cpu=native' $(CARGO) build $(PEERS) --target-dir target/native
	$(CARGO) build $(PEERS) --target-dir target/peers
	target/peers/release/pm-peers 7 target/native/release/pm-peers $(BENCH_AIMS) $(BENCH_PHOTONS) $(BENCH_QUERIES)

out/bench/%.pmp: $(call made_with,PROGRAMS)
	@mkdir -p $(@D)
	$(BIN)/pm-photons -q -n $* -t $(THREADS) -o $@

# The paper's queries, of which windows are measured: all of them make the orders as dense as they are.
.INTERMEDIATE: out/bench/all.pmq
out/bench/all.pmq: $(call made_with,PROGRAMS)
	@mkdir -p $(@D)
	$(BIN)/pm-queries -q --size 512x512 --gathers 100 -t $(THREADS) -o $@

BENCH_WINDOWS := --every 599808 --window 256 --warm-up 0

out/bench/scanline.pmq: out/bench/all.pmq
	$(BIN)/pm-sample -q $(BENCH_WINDOWS) $< -o $@

out/bench/hilbert.pmq out/bench/random.pmq: out/bench/%.pmq: out/bench/all.pmq
	$(BIN)/pm-reorder -q $* $< | $(BIN)/pm-sample -q $(BENCH_WINDOWS) -o $@

# Others' traces beside libCacheSim, if there is one: make bench-traces LIBCACHESIM=PYTHON. Some 46 million accesses an order.
TAKEN += bench-traces
LIBCACHESIM ?=
bench-traces: out/bench/scattered.pmt out/bench/ordered.pmt ## pm-cachesim beside libCacheSim (LIBCACHESIM=PYTHON): misses compared, seconds as ratios
	@test -n '$(LIBCACHESIM)' || { echo 'make bench-traces: LIBCACHESIM=PYTHON has to name a Python that has libcachesim 0.3.5' >&2; exit 2; }
	PATH="$(abspath $(BIN)):$$PATH" $(LIBCACHESIM) scripts/bench-traces.py --python $(LIBCACHESIM) $^

BENCH_TRACE := --size 64x64 --gathers 32
out/bench/scattered.pmt: out/bench/100000.pmp
	$(BIN)/pm-queries -q $(BENCH_TRACE) | $(BIN)/pm-reorder -q random | $(BIN)/pm-gather -q $< -o $@

out/bench/ordered.pmt: out/bench/100000.pmp
	$(BIN)/pm-queries -q $(BENCH_TRACE) | $(BIN)/pm-reorder -q hilbert | $(BIN)/pm-gather -q $< -o $@
