# Experiments as data: each table in scripts/sweeps names the points of a sweep, and each point is a target of its own,
# out/SWEEP/POINT.csv; out/SWEEP.csv has all of them. scripts/README.md says how a table is written.
#
#   make out/structures/kd.hilbert.128.csv     one point
#   make -j2 out/structures.csv                all
#   make -j2 sweep SWEEP=my.csv                a table of your own: out/my.csv, for pm-chart
#   make -j64 LAUNCH='srun ...' paper          on a cluster, inside an allocation
#   make KEEP=yes out/structures.csv           without making again what older programs made

SWEEP :=
KEEP :=
COUNTING :=
$(if $(filter-out yes,$(KEEP)),$(error KEEP=$(KEEP): yes or nothing is expected))

export PATH := $(CURDIR)/$(BIN):$(PATH)
comma := ,
.PHONY: always

# ---- what a file was made with ---------------------------------------------------------------------------------------

# $(call made_with,SIZE PHOTONS): files that are new if one of these variables has another value than it had when they were
# written; what depends on them is made again then. PROGRAMS is the fingerprint of the programs' sources, REPORTING that of those
# that make tables and pages of rows too; KEEP=yes takes them for unchanged.
made_with = $(foreach name,$(if $(KEEP),$(filter-out PROGRAMS REPORTING,$1),$1),$(call watch,$(name))out/.made/$(name))
watch = $(if $(WATCHED.$1),,$(eval WATCHED.$1 := yes)$(if $(call differ,$(value $1),$(file <out/.made/$1)),$(eval out/.made/$1: always)))
differ = $(subst x$1,,x$2)$(subst x$2,,x$1)

# `make -n` tells what would be made, and these are no news.
only_told := $(strip $(foreach flag,n q t,$(findstring $(flag),$(firstword -$(MAKEFLAGS)))))
quoted = '$(subst ','\'',$1)'
out/.made/%:
	@$(if $(only_told),,mkdir -p $(@D) && printf '%s\n' $(call quoted,$(value $*)) > $@)

# What a recipe reads: its prerequisites, without those files.
inputs = $(filter-out out/.made/%,$^)

# ---- rules, for the goals that make something ------------------------------------------------------------------------

# Made each time, since a variable may have another value; left alone when nothing changed, or make would begin anew. They need
# the programs, and one make at a time has the folder.
PLAIN := help programs test test-cluster check man options install dist stability clean clean-streams
ifneq ($(filter-out $(PLAIN),$(MAKECMDGOALS)),)
out/rules.mk: $(if $(MAKE_RESTARTS)$(COUNTING),,programs always)
	@mkdir -p $(@D)
	@$(if $(only_told),,$(BIN)/pm-sweep hold out --by $$PPID --what $(call quoted,make $(MAKECMDGOALS)) &&) \
	    $(BIN)/pm-sweep rules $(sort $(wildcard scripts/sweeps/*.csv)) --claims scripts/claims.csv --claims scripts/later-claims.csv --taken '$(TAKEN)' $(if $(SWEEP),--own $(call quoted,$(SWEEP))) -o $@
include out/rules.mk
endif

# Names that a table of one's own may not have, beside those of the tables here: other targets of make's are called so.
TAKEN := streams

# Rows appear whole or not at all. What ran is not believed when it says that it is done: there has to be a row. (A cluster's
# launcher can say 0 for a run that never ended.) What it said on standard error is kept beside a row that did not come.
define row
$(announced)$(counted)@mkdir -p $(@D)
$(LAUNCH) bash -euo pipefail -c 'rows=$$($1); printf "%s\n" "$$rows"' > $@.part 2> $@.said; pm-sweep row $@.part $@ --code $$? --said $@.said$(place)
endef

# ---- how much there is to do ---------------------------------------------------------------------------------------------

# Before the first stream or row is made: how many rows there are to make, counted by a make that only tells, and what the goal takes
# from nothing.
announced = $(if $(ANNOUNCED)$(COUNTING)$(only_told),,$(eval ANNOUNCED := yes)$(eval ROWS := $(rows_to_make))$(eval SINCE := $(shell date +%s))$(info \
    $(MAKE): $(ROWS) rows to make$(foreach goal,$(filter $(LONG),$(MAKECMDGOALS)),. From nothing, `make $(goal)` takes $(TAKES.$(goal)))$(if \
    $(filter $(LONG),$(MAKECMDGOALS)),; there are $(shell df -Ph . | awk 'END { print $$4 }') free)))
rows_to_make = $(shell $(MAKE) -n --no-print-directory COUNTING=yes $(MAKEOVERRIDES) $(MAKECMDGOALS) 2>/dev/null | grep -c '[>] out/.*pm-sweep row ')
# The rows that were begun, a word each.
counted = $(if $(COUNTING)$(only_told),,$(eval BEGUN += x))
place = $(if $(filter-out 0,$(ROWS)), --place $(words $(BEGUN))/$(ROWS) --since $(SINCE))

LONG := paper full-size frontier structures charts-cache accuracy need plan-coverage plan-traffic paper-exact
TAKES.paper := a quarter of an hour on two cores and 2 GB below out/
TAKES.full-size := an hour with -j2 and 1 GB below out/
TAKES.frontier := an hour with -j2 and 2 GB below out/
TAKES.structures := half an hour with -j2 and 1 GB below out/
TAKES.charts-cache := 12 minutes with -j2 and half a GB below out/
TAKES.accuracy := an hour
TAKES.need := twenty minutes
TAKES.plan-coverage := hours
TAKES.plan-traffic := an hour
TAKES.paper-exact := a working day

# So do streams, which the programs see to.
define stream
$(announced)@mkdir -p $(@D)
$(LAUNCH) bash -euo pipefail -c '$1 -o $@'
@test -s $@ || { echo "$@: was not made" >&2; exit 1; }
endef

sweep: $(OWN) ## SWEEP=my.csv: the points of a table of your own, joined in out/my.csv
	@$(if $(OWN),echo "$<: $$(($$(wc -l < $<) - 1)) rows",echo "give a table: make sweep SWEEP=my.csv (scripts/README.md says how it is written)" >&2; exit 2)
.PHONY: sweep
