# From joined rows of a sweep (frontier, full) to the points of the frontier:
#   awk -f scripts/frontier.awk out/full.csv out/frontier.csv
# On chip is the cache, what the order needs and the cache of results. A cache larger than the map holds the map; of those
# only the least is kept. What is thinned (one query in so many of a sorted stream) is multiplied as if searches shared nothing
# but the first touch of a line, so that its map and result traffic are at most so large. `best` is a point that no other of
# its series, with the same record, beats on both axes. What an earlier table has in full, with the same photons, is not taken
# from a later one, nor is what is thinned of an order that it has.

BEGIN {
    FS = ","
    results = 16384
    print "photons,series,record,point,share,found,cache_bytes,order_bytes,on_chip_bytes,map_bytes,query_bytes,result_bytes,total_bytes,best"
}

# Commas inside quotes are no separators.
{ gsub(/"[^"]*"/, "text") }

FNR == 1 { file++; split("", at); for (i = 1; i <= NF; i++) at[$i] = i; last = ""; next }

{
    photons = ("n" in at) ? $at["n"] : 450000
    if (("start" in at) && $at["start"] != "auto" || ("map" in at) && $at["map"] != "kd") next
    series = $at["order"]
    name = series ($at["tile"] == "" ? "" : "-" $at["tile"]) ($at["store"] == "" ? "" : "-" $at["store"])
    key = photons "," series "," $at["record"] "," name
    if (key != last) holds = 0
    last = key
    if (file == 1) in_full[key] = in_full[photons, series, $at["record"]] = 1
    else if (key in in_full || $at["found"] == "thinned" && (photons, series, $at["record"]) in in_full) next
    if (holds) next
    # Of the whole image, by the share that was simulated.
    times = $at["share"]; sub(/^1\//, "", times)
    # No line is fetched for the first time twice.
    first = $at["compulsory"] * times
    if (first > $at["blocks"]) first = $at["blocks"]
    map = ((($at["fetches"] - $at["compulsory"]) * times + first) * $at["line_bytes"]) + $at["bytes_written_back"] * times
    query = $at["query_bytes"] * times; result = $at["result_bytes"] * times
    rows++
    line[rows] = key "," $at["share"] "," $at["found"] "," $at["cache_bytes"] "," $at["order_bytes_on_chip"]
    group[rows] = photons "," series "," $at["record"]
    chip[rows] = $at["cache_bytes"] + $at["order_bytes_on_chip"] + results
    traffic[rows] = map + query + result
    parts[rows] = sprintf("%.0f,%.0f,%.0f", map, query, result)
    holds = $at["fetches"] == $at["compulsory"]
    if (holds && series == "scanline") {
        rows++
        line[rows] = photons ",cache holds the map," $at["record"] "," name "," $at["share"] "," $at["found"] "," $at["cache_bytes"] "," $at["order_bytes_on_chip"]
        group[rows] = photons ",cache holds the map," $at["record"]
        chip[rows] = chip[rows - 1]; traffic[rows] = traffic[rows - 1]; parts[rows] = parts[rows - 1]
    }
}

function row(front) { printf "%s,%.0f,%s,%.0f,%s\n", front, chip[i], parts[i], traffic[i], best }

END {
    for (i = 1; i <= rows; i++) {
        best = "yes"
        for (j = 1; j <= rows && best == "yes"; j++)
            if (group[j] == group[i] && chip[j] <= chip[i] && traffic[j] <= traffic[i] && (chip[j] < chip[i] || traffic[j] < traffic[i])) best = "no"
        row(line[i])
        # What stores no queries stands beside both kinds of records.
        if (group[i] ~ /,(scanline|cache holds the map),full$/) { sub(/,full,/, ",compact,", line[i]); row(line[i]) }
    }
}
