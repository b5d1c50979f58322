# make fuzz: readers given what nobody would write. It is built by nothing else; tests/fuzz/README.md tells what is found.

SECONDS ?= 60
SEED ?= 0
TARGETS ?=
GUIDED ?=

FUZZ := --release --manifest-path tests/fuzz/Cargo.toml
FUZZ_TARGETS = $(or $(TARGETS),streams mended parts traces rows scenes tables)
# What libFuzzer has to be told by the code: which edges were taken, and what was compared with what.
COVERED := --cfg fuzzing -Ccodegen-units=1 -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares

fuzz: ## SECONDS=60: each reader given changed inputs for so long, debug assertions on; SEED=0, TARGETS='mended parts', GUIDED=1
ifeq ($(GUIDED),)
	$(CARGO) build $(FUZZ) --bin pm-fuzz --target-dir target/fuzz
	target/fuzz/release/pm-fuzz $(SECONDS) $(SEED) $(TARGETS)
else
	host=$$(rustc -vV | sed -n 's/^host: //p'); \
	RUSTFLAGS='$(COVERED)' $(CARGO) build $(FUZZ) --features guided --bin guided --target $$host --target-dir target/guided || exit 1; \
	for target in $(FUZZ_TARGETS); do \
	    learnt=target/guided/learnt/$$target; \
	    mkdir -p $$learnt; \
	    echo "$$target:"; \
	    TARGET=$$target SEEDS=$$learnt target/guided/$$host/release/guided -max_total_time=$(SECONDS) -timeout=2 \
	        -malloc_limit_mb=512 -max_len=65536 -print_final_stats=1 -artifact_prefix=tests/fuzz/regressions/$$target- $$learnt || exit 1; \
	done
endif
