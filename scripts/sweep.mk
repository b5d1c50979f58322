# Experiments as data: each table in scripts/sweeps names the points of a sweep, and each point is a target of its own,
# out/SWEEP/POINT.csv; out/SWEEP.csv has all of them. scripts/sweep.awk says how a table is written.
#
#   make out/structures/kd.hilbert.128.csv     one point
#   make -j2 out/structures.csv                all
#   make -j2 sweep SWEEP=my.csv                a table of your own: out/my.csv, for pm-chart
#   make -j64 LAUNCH='srun ...' paper          on a cluster, inside an allocation

SWEEP :=
SWEEP_TABLES := $(wildcard scripts/sweeps/*.csv) $(SWEEP)
SWEEP_NAMES := $(basename $(notdir $(SWEEP_TABLES)))
vpath %.csv scripts/sweeps $(dir $(SWEEP))

export PATH := $(CURDIR)/$(BIN):$(PATH)
comma := ,

# Rows appear whole or not at all. What ran is not believed when it says that it is done: there has to be a row. (A cluster's
# launcher can say 0 for a run that never ended.)
define row
@mkdir -p $(@D)
$(LAUNCH) bash -euo pipefail -c 'rows=$$($1); printf "%s\n" "$$rows"' > $@.part
@awk 'END { if (NR < 2) { print "$@: no row came back" > "/dev/stderr"; exit 1 } }' $@.part
@mv $@.part $@
endef

# So do streams, which the programs see to.
define stream
@mkdir -p $(@D)
$(LAUNCH) bash -euo pipefail -c '$1 -o $@'
@test -s $@ || { echo "$@: was not made" >&2; exit 1; }
endef

# Made each time, since a variable may have another value; left alone when nothing changed, or make would begin anew.
out/sweeps/%.mk: %.csv scripts/words.csv scripts/csv.awk scripts/sweep.awk always
	@mkdir -p $(@D)
	@awk -v sweep=$* -f scripts/csv.awk -f scripts/sweep.awk scripts/words.csv $< > $@.part && { cmp -s $@.part $@ && rm $@.part || mv $@.part $@; }
.PHONY: always

ifneq ($(MAKECMDGOALS),clean)
include $(SWEEP_NAMES:%=out/sweeps/%.mk)
endif

define sweep_rules
out/$1.csv: $$(POINTS.$1)
	@awk -v sweep=$1 -v list=1 -f scripts/csv.awk -f scripts/sweep.awk scripts/words.csv $(filter %/$1.csv $1.csv,$(SWEEP_TABLES)) | awk -f scripts/csv.awk -f scripts/join.awk > $$@
endef
$(foreach name,$(SWEEP_NAMES),$(eval $(call sweep_rules,$(name))))

sweep: $(patsubst %,out/%.csv,$(basename $(notdir $(SWEEP)))) ## SWEEP=my.csv: the points of a table of your own, joined in out/my.csv
	@$(if $(SWEEP),echo "$<: $$(awk 'END { print NR - 1 }' $<) rows",echo "give a table: make sweep SWEEP=my.csv (scripts/sweep.awk says how it is written)"; exit 2)
.PHONY: sweep
