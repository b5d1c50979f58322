# Orders by name: the pipe that makes queries in that order. $(1): what is rendered, options of pm-queries; $(2): the
# photon map, for orders that look at it; $(3): options that say what is stored on chip.

TILED = $(BIN)/pm-queries $(1) --order tiled
BINNED = $(BIN)/pm-queries $(1) --order direction-binned

ORDER_scanline = $(BIN)/pm-queries $(1)
ORDER_tiled = $(TILED)
ORDER_binned = $(BINNED)
ORDER_binned-hashed = $(BINNED) | $(BIN)/pm-reorder hashed $(3)
ORDER_tiled-hilbert = $(TILED) | $(BIN)/pm-reorder hilbert --per batch $(3)
ORDER_hashed = $(ORDER_scanline) | $(BIN)/pm-reorder hashed $(3)
ORDER_hilbert = $(ORDER_scanline) | $(BIN)/pm-reorder hilbert $(3)
ORDER_morton = $(ORDER_scanline) | $(BIN)/pm-reorder morton $(3)
ORDER_leaf = $(ORDER_scanline) | $(BIN)/pm-reorder leaf --photons $(2) $(3)
ORDER_random = $(ORDER_scanline) | $(BIN)/pm-reorder random $(3)
ORDER_partition = $(ORDER_scanline) | $(BIN)/pm-reorder partition $(3)
ORDER_cells = $(ORDER_scanline) | $(BIN)/pm-reorder cells --photons $(2) $(3)
ORDER_snowplow = $(ORDER_scanline) | $(BIN)/pm-reorder snowplow $(3)
ORDER_buffered = $(ORDER_scanline) | $(BIN)/pm-reorder buffered $(3)

# Tables with the same columns as one.
JOIN = pm-sweep stack
