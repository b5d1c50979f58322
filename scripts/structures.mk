# make structures: every photon map under every line size (Figure 8) and order (Table 1), in a cache of 128 KiB. The points
# stand in scripts/sweeps/structures.csv.

STRUCTURE_SHARE ?= 16
STRUCTURE_SIZE ?= 512x512
export STRUCTURE_SHARE STRUCTURE_SIZE

structures: out/structures/scanline.svg out/structures/hilbert.svg out/structures/table.txt ## Every photon map: Figure 8 and Table 1 of the paper (-j2: twenty minutes)
	@cat out/structures/table.txt

out/structures/table.txt: out/structures.csv $(call made_with,STRUCTURE_SHARE REPORTING)
	$(BIN)/pm-sweep derive structures --with share=$(STRUCTURE_SHARE) $< -o $@

out/structures/scanline.svg out/structures/hilbert.svg: out/structures/%.svg: out/structures.csv $(call made_with,STRUCTURE_SHARE REPORTING)
	pm-chart -q $< -x line -y bytes_per_query --error bytes_per_query_error --by map --only order=$* --x-scale log2 --y-scale log10 --x-label 'bytes of a line' \
	    --title 'Bytes fetched per query and line size, $*: cache of 128 KiB$(if $(filter hilbert,$*),$(comma) one query in $(STRUCTURE_SHARE))' -o $@
