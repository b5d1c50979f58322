# Joins rows of `pm-cachesim --format csv`, one file MAP.ORDER.LINE.csv a point, into one table of few columns:
#   awk -f scripts/structures.awk out/structures/kd.scanline.128.csv ...

BEGIN { FS = ","; OFS = ","; print "map", "stream", "line_bytes", "queries", "reads_per_query", "blocks", "fetches", "fetches_per_query", "fetches_per_block", "bytes_per_query" }

# Commas inside quotes are no separators.
{ gsub(/"[^"]*"/, "text") }

FNR == 1 {
    split("", at)
    for (i = 1; i <= NF; i++) at[$i] = i
    name = FILENAME; sub(/.*\//, "", name)
    split(name, part, ".")
    next
}

{
    print part[1], part[2], part[3], $at["queries"], $at["reads_per_query"], $at["blocks"], $at["fetches"], \
        $at["fetches_per_query"], $at["fetches_per_block"], $at["bytes_per_query"]
}
