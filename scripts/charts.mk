# make charts-cache: what each order makes of caches of any size, of few ways, and of many searches in flight.

CHART_ORDERS := scanline tiled binned binned-hashed tiled-hilbert hashed hilbert morton leaf random partition snowplow
CHART_SCENE := --size 96x96
CHART_WAYS := 1,2,4,8,16,full
CHART_LISTS := 1,4,16,64

.SECONDEXPANSION:

CHART_LANES := 4 16 64
TAKEN += charts

charts-cache: out/charts/sizes.svg out/charts/ways.svg out/charts/lanes.svg out/charts/parts.svg $(CHART_LANES:%=out/charts/sizes-%.svg) ## Fetches of every order against size, ways, lanes (-j2: 12 minutes)

out/charts/map.pmp: $(call made_with,PROGRAMS)
	mkdir -p $(@D)
	$(LAUNCH) $(BIN)/pm-photons -n 450000 -t $(THREADS) -o $@

out/charts/%.pmt: out/charts/map.pmp $(call made_with,CHART_SCENE)
	$(LAUNCH) sh -c '$(call ORDER_$*,$(CHART_SCENE),$<,) | $(BIN)/pm-gather $< -t $(THREADS) -o $@'

out/charts/%.sizes: out/charts/%.pmt
	$(call row,pm-cachesim --curve --sizes 4K..16M --format csv $<)

out/charts/%.ways: out/charts/%.pmt $(call made_with,CHART_WAYS)
	$(call row,pm-cachesim --ways $(CHART_WAYS) --format csv $<)

out/charts/%.lanes: out/charts/%.pmt $(call made_with,CHART_LISTS)
	$(call row,pm-cachesim --lanes $(CHART_LISTS) --format csv $<)

# The same, a part of each batch (scanline, tile; after an order over the whole image: the image) in each lane.
out/charts/%.parts: out/charts/%.pmt $(call made_with,CHART_LISTS)
	$(call row,pm-cachesim --lanes $(CHART_LISTS) --lanes-from parts --format csv $<)

$(foreach lanes,$(CHART_LANES),$(CHART_ORDERS:%=out/charts/%.sizes-$(lanes))): out/charts/%: $$(basename out/charts/$$*).pmt
	$(call row,pm-cachesim --curve --sizes 4K..16M --lanes $(lastword $(subst -, ,$*)) --format csv $<)

CHART_TABLES := sizes ways lanes parts $(CHART_LANES:%=sizes-%)

$(CHART_TABLES:%=out/charts/%.csv): out/charts/%.csv: $$(addprefix out/charts/,$$(addsuffix .$$*,$$(CHART_ORDERS))) $(call made_with,CHART_ORDERS REPORTING)
	$(JOIN) $(inputs) -o $@

CHART = $(BIN)/pm-chart $< -y fetches_per_query --by order --y-scale log10 -o $@

out/charts/sizes.svg: out/charts/sizes.csv $(call made_with,REPORTING)
	$(CHART) -x cache_bytes --title 'Fetches per query and size of a fully associative LRU cache with lines of 128 bytes'

out/charts/ways.svg: out/charts/ways.csv $(call made_with,REPORTING)
	$(CHART) -x ways --title 'Fetches per query and ways of a cache of 128 KiB'

out/charts/lanes.svg: out/charts/lanes.csv $(call made_with,REPORTING)
	$(CHART) -x lanes --x-scale log2 --title 'Fetches per query and searches in flight over one cache of 128 KiB'

out/charts/parts.svg: out/charts/parts.csv $(call made_with,REPORTING)
	$(CHART) -x lanes --x-scale log2 --title 'The same, each lane with a part of a batch of its own'

$(CHART_LANES:%=out/charts/sizes-%.svg): out/charts/%.svg: out/charts/%.csv $(call made_with,REPORTING)
	$(CHART) -x cache_bytes --title 'Fetches per query and size of the cache, $(lastword $(subst -, ,$*)) searches in flight'

.PRECIOUS: out/charts/%.pmt
