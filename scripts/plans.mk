# make plan-coverage: how often is the error at most what pm-plan was asked for? Each point is out/plans/ROOM.ERROR.csv: one plan,
# and PLAN_RUNS runs of it with fresh seeds. Plans that take more than PLAN_SECONDS of processor time are refused. What is there stays, so that it may be stopped and started again.

PLAN_SIZE ?= 48x48
PLAN_RUNS ?= 20
PLAN_SECONDS ?= 300
export PLAN_SIZE PLAN_RUNS PLAN_SECONDS

plan-coverage: out/plans.csv ## How often pm-plan's promise is kept: eight rooms, three errors, 20 seeds each (hours; PLAN_SECONDS=8: half an hour)
	@awk -F, -f scripts/plan-coverage.awk $<
	@cmp -s $< scripts/plans.csv || echo 'The report shows other numbers: cp $< scripts/plans.csv'

# Searches of which samples are measured have to be more than these, and few enough that the whole is measured soon.
TRAFFIC_SIZE ?= 96x96
TRAFFIC_RUNS ?= 10
TRAFFIC_EFFORT := --pixels 144 --pilot-photons 20000
export TRAFFIC_SIZE TRAFFIC_RUNS TRAFFIC_EFFORT

plan-traffic: out/plan-traffic.csv ## How often bytes are what pm-plan --on-chip foretells: four rooms, two errors, two chips, ten seeds each (an hour)
	@awk -F, -f scripts/plan-traffic.awk $<
	@cmp -s $< scripts/plan-traffic.csv || echo 'Other numbers than those that are kept: cp $< scripts/plan-traffic.csv'

# Ten times the effort of the finest plan and more, with k so small and photons so many that nothing is blurred.
PLAN_REFERENCE := --samples 4096 --gathers 4 --light-samples 4 -n 4000000 -k 10 --caustics 2000000 --seed 7777
plan_scene = $(or $(wildcard scenes/$1.obj),out/scenes/$1.obj)
.SECONDEXPANSION:
out/plans/%.exr: $$(call plan_scene,$$*) $(call made_with,PLAN_SIZE PLAN_REFERENCE)
	@mkdir -p $(@D)
	$(LAUNCH) pm-picture -q $< $(if $(findstring glossy,$*),--glossy) --size $(PLAN_SIZE) $(PLAN_REFERENCE) -t $(THREADS) --image $@

# The whole grid of photons, neighbours and rays, for any scene.
ROOM ?= cornell-diffuse
export ROOM

need: out/need.csv out/need-plans.csv ## What a scene needs: error, seconds and bytes of photons x neighbours x rays beside pm-plan's choices, ROOM=cornell-diffuse (half an hour)
	@awk -F, -f scripts/need.awk $^
