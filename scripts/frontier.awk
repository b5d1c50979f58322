# From rows of `pm-cachesim --format csv`, one file a point, to the points of the frontier:
#   awk -v share=16 -f scripts/frontier.awk out/frontier/450000/*.csv
# On chip is the cache, what the order needs and the cache of results. A cache larger than the map holds the map; of those
# only the least is kept.

BEGIN {
    FS = ","; OFS = ","
    results = 16384
    print "point", "share", "cache_bytes", "order_bytes", "on_chip_bytes", "map_bytes_per_query", "query_bytes_per_query", \
        "result_bytes_per_query", "total_bytes_per_query", "total_bytes"
}

# Commas inside quotes are no separators.
{ gsub(/"[^"]*"/, "text") }

FNR == 1 {
    split("", at)
    for (i = 1; i <= NF; i++) at[$i] = i
    name = FILENAME; sub(/.*\//, "", name); sub(/\.csv$/, "", name)
    holds = 0
    next
}

holds { next }

{
    queries = $at["queries"]
    map = $at["bytes_fetched"] + $at["bytes_written_back"]
    total = map + $at["query_bytes"] + $at["result_bytes"]
    on_chip = $at["cache_bytes"] + $at["order_bytes_on_chip"] + results
    print name, "1/" share, $at["cache_bytes"], $at["order_bytes_on_chip"], on_chip, map / queries, \
        $at["query_bytes"] / queries, $at["result_bytes"] / queries, total / queries, sprintf("%.0f", total * share)
    holds = $at["fetches"] == $at["compulsory"]
}
