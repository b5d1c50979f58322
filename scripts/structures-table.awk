# Table 1 of Steinhurst, Coombe, Lastra, GI 2005, from the joined rows of structures.csv, at lines of 128 bytes:
#   awk -F, -v share=64 -f scripts/structures-table.awk out/structures.csv
# In fetches and bytes per query and in fetches per block, with half the width of the interval where there is one.

# Commas inside quotes are no separators.
{ gsub(/"[^"]*"/, "text") }

FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }

$at["line"] == 128 {
    map = $at["map"]; stream = $at["order"]
    if (!(map in seen)) { seen[map] = 1; maps[++number] = map }
    query[map, stream] = $at["fetches_per_query"]
    block[map, stream] = $at["fetches_per_block"]
    bytes[map, stream] = $at["bytes_per_query"]
    if ($at["fetches_per_query"] > 0) half[map, stream] = 100 * $at["fetches_per_query_error"] / $at["fetches_per_query"]
}

function row(name, text, columns,   i) {
    printf "%-16s", name
    for (i = 1; i <= columns; i++) printf " %18s", text[i]
    print ""
}

# The half width of the interval in percent.
function told(value, half) { return sprintf(value < 1000 ? "%.4g" : "%.0f", value) (half > 0 ? sprintf(" +-%.1f%%", half) : "") }

function part(title, value, columns,   i, j, text) {
    print title
    for (j = 1; j <= columns; j++) text[j] = orders[j]
    row("map", text, columns)
    for (i = 1; i <= number; i++) {
        for (j = 1; j <= columns; j++) text[j] = ((maps[i], orders[j]) in value) ? told(value[maps[i], orders[j]], half[maps[i], orders[j]]) : "-"
        row(maps[i], text, columns)
    }
}

END {
    split("scanline binned binned-hashed tiled-hilbert hilbert random", orders, " ")
    printf "Windows, but of hilbert one query in %d of the sorted stream, dearer per query, not per block;\nof random one in 512, which are as dear as all.\n\n", share
    part("Fetches per query, lines of 128 bytes, cache of 128 KiB:", query, 6)
    print ""
    part("Bytes fetched per query:", bytes, 6)
    print ""
    part("Fetches per block of the map. Maps differ in blocks, so columns compare and rows do not:", block, 5)
    print ""
    print "The paper, fetches per block: naive 23,045 kd, 11,755 kdB, 73,523 block hashing; tiled direction-binned 3,927, 4,397,"
    print "20,316; with hash 2,590, 2,870, 9,912; tiled Hilbert 1,215, 1,134, 2,350; Hilbert 1.6, 1.8, 3.1."
}
