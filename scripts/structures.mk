# make structures: every photon map under every line size (Figure 8) and order (Table 1), in a cache of 128 KiB. Each point
# is out/structures/MAP.ORDER.LINE.csv, made from a share of the queries: one batch in STRUCTURE_SHARE, or, of Hilbert over
# the whole image, one query in STRUCTURE_SHARE of the sorted stream. The full column of the kd-tree is `make full-size`.

STRUCTURE_SHARE := 64
STRUCTURE_SIZE := 512x512
STRUCTURE_LINES := 32 64 128 256 512 1024
STRUCTURES := kd kd-preorder kd-veb kd-pad bucket-kd bucket-kd-veb vvh kdb kdb-compact grid grid-fixed block-hash
STRUCTURE_ORDERS := scanline binned binned-hashed tiled-hilbert hilbert

# Options of pm-gather by the map's name. At 32 bytes only the compact page of a kdB-tree fits.
MAP_kd := --map kd
MAP_kd-preorder := --map kd --layout preorder
MAP_kd-veb := --map kd --layout veb
MAP_kd-pad := --map kd --pad
MAP_bucket-kd := --map bucket-kd
MAP_bucket-kd-veb := --map bucket-kd --layout veb
MAP_vvh := --map vvh
MAP_kdb := --map kdb --pages boxes
MAP_kdb-compact := --map kdb --pages compact
MAP_grid := --map grid
MAP_grid-fixed := --map grid-fixed
MAP_block-hash := --map block-hash --budget 20
IMPOSSIBLE := kdb.%.32

STRUCTURE_POINTS := $(filter-out $(foreach map,$(IMPOSSIBLE),$(foreach order,scanline hilbert,$(subst %,$(order),$(map)))), \
    $(foreach map,$(STRUCTURES),$(foreach order,scanline hilbert,$(foreach line,$(STRUCTURE_LINES),$(map).$(order).$(line)))))
TABLE_POINTS := $(foreach map,$(STRUCTURES),$(foreach order,$(STRUCTURE_ORDERS),$(map).$(order).128))

structures: out/structures/scanline.svg out/structures/hilbert.svg out/structures/table.txt ## Every photon map: Figure 8 and Table 1 of the paper (-j2: 15 minutes)
	@cat out/structures/table.txt

out/structures/map.pmp: | programs
	mkdir -p $(@D)
	$(LAUNCH) $(BIN)/pm-photons -n 450000 -t $(THREADS) -o $@

SCENE_OF_STRUCTURES := --size $(STRUCTURE_SIZE) -t $(THREADS)
BATCHES_OF_STRUCTURES = | $(BIN)/pm-sample --batches $(STRUCTURE_SHARE)
out/structures/scanline.pmq: | programs
	mkdir -p $(@D)
	$(LAUNCH) sh -c '$(BIN)/pm-queries $(SCENE_OF_STRUCTURES) $(BATCHES_OF_STRUCTURES) -o $@'
out/structures/binned.pmq: | programs
	mkdir -p $(@D)
	$(LAUNCH) sh -c '$(BIN)/pm-queries $(SCENE_OF_STRUCTURES) --order direction-binned $(BATCHES_OF_STRUCTURES) -o $@'
out/structures/binned-hashed.pmq: out/structures/binned.pmq
	$(LAUNCH) $(BIN)/pm-reorder hashed $< -o $@
out/structures/tiled-hilbert.pmq: | programs
	mkdir -p $(@D)
	$(LAUNCH) sh -c '$(BIN)/pm-queries $(SCENE_OF_STRUCTURES) --order tiled $(BATCHES_OF_STRUCTURES) | \
	    $(BIN)/pm-reorder hilbert --per batch --storage 4M -o $@'
out/structures/hilbert.pmq: | programs
	mkdir -p $(@D)
	$(LAUNCH) sh -c '$(BIN)/pm-queries $(SCENE_OF_STRUCTURES) | $(BIN)/pm-reorder hilbert | $(BIN)/pm-sample --queries $(STRUCTURE_SHARE) -o $@'

.SECONDEXPANSION:
part = $(word $1,$(subst ., ,$*))
STRUCTURE_ROWS := $(sort $(STRUCTURE_POINTS) $(TABLE_POINTS))
$(STRUCTURE_ROWS:%=out/structures/%.csv): out/structures/%.csv: out/structures/map.pmp out/structures/$$(call part,2).pmq
	$(LAUNCH) sh -c '$(BIN)/pm-gather $^ $(MAP_$(call part,1)) --line $(call part,3) -t $(THREADS) | \
	    $(BIN)/pm-cachesim --lines $(call part,3) --format csv' > $@

# The names of the points as columns of their own.
out/structures/all.csv: $(STRUCTURE_ROWS:%=out/structures/%.csv)
	awk -f scripts/structures.awk $^ > $@

out/structures/table.txt: out/structures/all.csv scripts/structures-table.awk
	awk -F, -v share=$(STRUCTURE_SHARE) -f scripts/structures-table.awk $< > $@

out/structures/scanline.svg out/structures/hilbert.svg: out/structures/%.svg: out/structures/all.csv
	$(BIN)/pm-chart $< -x line_bytes -y bytes_per_query --by map --only stream=$* --x-scale log2 --y-scale log10 \
	    --title 'Bytes fetched per query and line size, $*: cache of 128 KiB, one query in $(STRUCTURE_SHARE)' -o $@

.SECONDARY: out/structures/map.pmp $(STRUCTURE_ORDERS:%=out/structures/%.pmq)
