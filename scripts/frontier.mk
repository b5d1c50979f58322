# make frontier: all bytes on chip (cache, the order's store and tables, result cache) against all traffic (map, spilled
# queries, results), for every order and cache size. Each point is out/frontier/PHOTONS/POINT.csv, made from a share of
# the queries: one batch in SHARE, or, of orders over the whole image, one query in SHARE of the sorted stream.
#
#   make frontier SHARE=64                    a quarter of the time
#   make frontier FRONTIER_PHOTONS=450000     one map instead of three
#   make frontier BUDGET=35 FPS=1             and the cheapest point that needs no more than 35 GB/s at one frame a second

SHARE := 16
FRONTIER_SIZE := 512x512
FRONTIER_PHOTONS := 100000 450000 4000000
BUDGET :=
FPS := 1
STORES := 256K 1M 4M

# Points as ORDER, ORDER-STORE or ORDER-STORE-compact; of tiled-hilbert the number is the side of a tile.
FRONTIER_STREAMED := scanline tiled-16 binned-16 binned-16-hashed $(foreach tile,8 16 32 64,tiled-$(tile)-hilbert) \
    $(foreach store,$(STORES),$(foreach order,snowplow buffered,$(order)-$(store) $(order)-$(store)-compact))
FRONTIER_SORTED := hilbert $(foreach store,$(STORES),partition-$(store) partition-$(store)-compact) \
    cells-1M cells-1M-compact random
FRONTIER_POINTS := $(FRONTIER_STREAMED) $(FRONTIER_SORTED)

frontier: $(FRONTIER_PHOTONS:%=out/frontier/%.svg) ## Bytes on chip against total traffic, every order (half an hour with -j2; SHARE=64: a quarter)
	@$(if $(BUDGET),awk -v budget=$(BUDGET) -v fps=$(FPS) -f scripts/budget.awk $(FRONTIER_PHOTONS:%=out/frontier/%.csv),echo 'Charts: $^')

out/frontier/%/map.pmp: | programs
	mkdir -p $(@D)
	$(LAUNCH) $(BIN)/pm-photons -n $* -t $(THREADS) -o $@

# A share of the batches, cast once for all points that begin with it; all queries, for those that sort them.
SCENE_OF_FRONTIER := --size $(FRONTIER_SIZE) -t $(THREADS)
ONE_IN = | $(BIN)/pm-sample --batches $(SHARE) -o $@
out/frontier/scanline.pmq: | programs
	mkdir -p $(@D)
	$(LAUNCH) sh -c '$(BIN)/pm-queries $(SCENE_OF_FRONTIER) $(ONE_IN)'
out/frontier/tiled-%.pmq: | programs
	mkdir -p $(@D)
	$(LAUNCH) sh -c '$(BIN)/pm-queries $(SCENE_OF_FRONTIER) --order tiled --tile $* $(ONE_IN)'
out/frontier/binned-%.pmq: | programs
	mkdir -p $(@D)
	$(LAUNCH) sh -c '$(BIN)/pm-queries $(SCENE_OF_FRONTIER) --order direction-binned --tile $* $(ONE_IN)'
out/frontier/all.pmq: | programs
	mkdir -p $(@D)
	$(LAUNCH) $(BIN)/pm-queries $(SCENE_OF_FRONTIER) -o $@

# What becomes of a stream on its way to the map, by the words of the point's name; $(1): the map.
point = $(subst -, ,$(notdir $*))
stored = --storage $(word 2,$(point)) $(if $(filter compact,$(point)),--record compact)
POINT_scanline =
POINT_tiled = $(if $(filter hilbert,$(point)),hilbert --per batch --storage 4M)
POINT_binned = $(if $(filter hashed,$(point)),hashed)
POINT_snowplow = snowplow $(stored)
POINT_buffered = buffered --photons $(1) $(stored)
POINT_hilbert = hilbert
POINT_random = random
POINT_partition = partition $(stored)
POINT_cells = cells --photons $(1) $(stored)
reorder = $(call POINT_$(firstword $(point)),$(1))
# Streaming orders take what comes tile by tile.
FROM_scanline = scanline
FROM_tiled = $(wordlist 1,2,$(point))
FROM_binned = $(wordlist 1,2,$(point))
FROM_snowplow = tiled 16
FROM_buffered = tiled 16
from = $(or $(FROM_$(firstword $(point))),all)
empty :=
from_file = out/frontier/$(subst $(empty) $(empty),-,$(from)).pmq

.SECONDEXPANSION:
FRONTIER_ROWS := $(foreach photons,$(FRONTIER_PHOTONS),$(FRONTIER_POINTS:%=out/frontier/$(photons)/%.csv))
$(FRONTIER_ROWS): out/frontier/%.csv: out/frontier/$$(firstword $$(subst /, ,$$*))/map.pmp $$(from_file)
	$(LAUNCH) sh -c '$(if $(reorder),$(BIN)/pm-reorder $(call reorder,$<) $(from_file) | )$(if $(filter all,$(from)),$(BIN)/pm-sample --queries $(SHARE) | )\
	    $(BIN)/pm-gather $< $(if $(reorder),-,$(from_file)) -t $(THREADS) | $(BIN)/pm-cachesim --sizes 4K..128M --format csv' > $@

$(FRONTIER_PHOTONS:%=out/frontier/%.csv): out/frontier/%.csv: $$(addprefix out/frontier/$$*/,$$(addsuffix .csv,$$(FRONTIER_POINTS)))
	awk -v share=$(SHARE) -f scripts/frontier.awk $^ > $@

$(FRONTIER_PHOTONS:%=out/frontier/%.svg): %.svg: %.csv
	$(BIN)/pm-chart $< -x on_chip_bytes -y total_bytes_per_query --by point --x-scale log2 --y-scale log10 --frontier --size 1100x760 \
	    --title 'Bytes on chip and total traffic: $(notdir $*) photons, one batch or query in $(SHARE)' -o $@

.SECONDARY: $(FRONTIER_PHOTONS:%=out/frontier/%/map.pmp) out/frontier/all.pmq out/frontier/scanline.pmq $(FRONTIER_ROWS) \
    $(foreach tile,8 16 32 64,out/frontier/tiled-$(tile).pmq) out/frontier/binned-16.pmq
