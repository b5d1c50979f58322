# make frontier: all bytes on chip (cache, the order's store and tables, result cache) against all traffic (map, spilled
# queries, results), for every order and cache size. The points stand in scripts/sweeps/frontier.csv and, in full, in full.csv.
#
#   make frontier SHARE=64                    a quarter of the time
#   make frontier BUDGET=35 FPS=1             and the cheapest point that needs no more than 35 GB/s at one frame a second

SHARE ?= 16
FRONTIER_SIZE ?= 512x512
export SHARE FRONTIER_SIZE
BUDGET :=
FPS := 1
FRONTIER_CHARTS := $(foreach photons,100000 450000 4000000,out/frontier/$(photons).svg out/frontier/$(photons)-compact.svg)

frontier: $(FRONTIER_CHARTS) ## Bytes on chip against total traffic, every order (an hour with -j2; SHARE=64: half of it)
	@$(if $(BUDGET),$(BIN)/pm-sweep derive budget --with budget=$(BUDGET) --with fps=$(FPS),echo 'Charts: $^' && $(BIN)/pm-sweep derive least) out/frontier/points.csv

# What was simulated in full is only of use at the same size.
out/frontier/points.csv: $(if $(filter 512x512,$(FRONTIER_SIZE)),out/full.csv) out/frontier.csv $(call made_with,FRONTIER_SIZE REPORTING)
	$(BIN)/pm-sweep derive frontier $(filter %.csv,$^) -o $@

# Records of 44 bytes, and of 9 where an order has them.
frontier_of = --only photons=$1 --only best=yes --only record=$2 --reference scripts/paper-frontier.csv
out/frontier/%.svg: out/frontier/points.csv scripts/paper-frontier.csv $(call made_with,REPORTING)
	pm-chart -q $< -x on_chip_bytes -y total_bytes --by series --x-scale log2 --y-scale log10 --size 1100x760 \
	    $(call frontier_of,$(firstword $(subst -, ,$*)),$(if $(findstring compact,$*),compact,full)) \
	    --x-label 'bytes on chip: cache, store and tables of the order, results' --y-label 'bytes of traffic: map, queries, results' \
	    --title '$(firstword $(subst -, ,$*)) photons$(if $(findstring compact,$*),$(comma) compact records)' -o $@
