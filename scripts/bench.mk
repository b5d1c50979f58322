# make bench: speed, as ratios measured side by side in one run. The peers are built by nothing else.

TAKEN += bench
PEERS := --release --manifest-path tests/peers/Cargo.toml
BENCH_PHOTONS := out/bench/450000.pmp out/bench/100000.pmp
BENCH_QUERIES := out/bench/hilbert.pmq out/bench/scanline.pmq out/bench/random.pmq
# How many photons are looked for, and within which distance.
BENCH_AIMS := 10,50,100,500,100@0.01

bench: $(BENCH_PHOTONS) $(BENCH_QUERIES) ## Speed, as ratios measured side by side, to other libraries as well: five minutes, and twelve of building the first time
	$(CARGO) bench -p pm-programs --bench '*'
	$(call build_peers)
	$(RACE) ratios 7 $(NATIVE) $(BENCH_AIMS) $(BENCH_PHOTONS) $(BENCH_QUERIES)

NATIVE := target/native/release/pm-peers
RACE := target/peers/release/pm-peers
define build_peers
	RUSTFLAGS='-C target-cpu=native' $(CARGO) build $(PEERS) --target-dir target/native
	$(CARGO) build $(PEERS) --target-dir target/peers
endef

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

# How costs grow: with photons, with k, and with the queries of the picture.
TAKEN += bench-growth
GROWTH := out/bench/growth
GROWTH_PHOTONS := 10000 30000 100000 300000 1000000 3000000 10000000
GROWTH_K := 1,3,10,30,100,300,1000
# Gather rays a pixel.
GROWTH_GATHERS := 1 10 100
GROWTH_QUERIES := $(foreach gathers,$(GROWTH_GATHERS),$(GROWTH)/hilbert-$(gathers).pmq $(GROWTH)/scanline-$(gathers).pmq)

bench-growth: $(GROWTH)/photons.csv $(GROWTH)/k.csv $(GROWTH)/queries.csv $(call made_with,REPORTING) ## How costs grow with photons (to 10 million), k (to 1000) and queries (to 20 million), beside other libraries: charts (-j1: ten minutes)
	$(BIN)/pm-chart -q --anyway --page scripts/growth.toml -o $(GROWTH)/report.html
	@echo "How costs grow: $(GROWTH)/report.html"

peers:
	$(call build_peers)

$(GROWTH)/photons.csv: $(GROWTH_PHOTONS:%=out/bench/%.pmp) $(GROWTH)/hilbert-100.pmq $(GROWTH)/scanline-100.pmq | peers
	$(RACE) growth 3 $(NATIVE) 100 $^ > $@

$(GROWTH)/k.csv: out/bench/450000.pmp $(GROWTH)/hilbert-100.pmq $(GROWTH)/scanline-100.pmq | peers
	$(RACE) growth 5 $(NATIVE) $(GROWTH_K) $^ > $@

$(GROWTH)/queries.csv: out/bench/450000.pmp $(GROWTH_QUERIES) | peers
	$(RACE) growth 5 $(NATIVE) 100 $^ > $@

# Windows as far apart as leave some thirty of them.
GROWTH_WINDOWS = --every $$(($(1) * 23 * 256)) --window 256 --warm-up 0

.INTERMEDIATE: $(GROWTH_GATHERS:%=$(GROWTH)/all-%.pmq)
$(GROWTH)/all-%.pmq: $(call made_with,PROGRAMS)
	@mkdir -p $(@D)
	$(BIN)/pm-queries -q --size 512x512 --gathers $* -t $(THREADS) -o $@

$(GROWTH)/scanline-%.pmq: $(GROWTH)/all-%.pmq
	$(BIN)/pm-sample -q $(call GROWTH_WINDOWS,$*) $< -o $@

$(GROWTH)/hilbert-%.pmq: $(GROWTH)/all-%.pmq
	$(BIN)/pm-reorder -q hilbert $< | $(BIN)/pm-sample -q $(call GROWTH_WINDOWS,$*) -o $@

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
