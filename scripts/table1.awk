# The paper's Table 1 from the joined rows of table1.csv, beside the paper's own:
#   awk -f scripts/csv.awk -f scripts/table1.awk scripts/paper-table1.csv out/table1.csv
# Fetches per block compare between orders of one map, not between maps, which differ in blocks. So does the share of the
# plain order, in which the paper's and ours can be compared. Of a thinned stream fetches per block are what holds for the whole.

BEGIN { FS = ","; print "order,map,found,queries_simulated,fetches_per_query,fetches_per_query_error,fetches_per_block,share_of_scanline,paper_fetches_per_block,paper_share_of_scanline,ratio,history" }

FNR == 1 { file++; split("", at); for (i = 1; i <= NF; i++) at[$i] = i; next }
file == 1 { paper[$at["order"], $at["map"]] = $at["fetches_per_block"]; next }

{
    split_line($0, cell)
    rows++
    order[rows] = cell[at["order"]]; map[rows] = cell[at["map"]]
    simulated = cell[at["queries_simulated"]]
    front[rows] = order[rows] "," map[rows] "," cell[at["found"]] "," (simulated == "" ? cell[at["queries"]] : simulated) "," \
        cell[at["fetches_per_query"]] "," cell[at["fetches_per_query_error"]]
    block[rows] = cell[at["fetches_per_block"]]
    history[rows] = cell[at["history"]]
    found[rows] = cell[at["found"]]
    # One query in so many of a random order stands for all.
    if (order[rows] == "random" && found[rows] == "thinned") block[rows] *= 512
    if (order[rows] == "scanline") plain[map[rows]] = block[rows]
}

END {
    for (r = 1; r <= rows; r++) {
        share = block[r] / plain[map[r]]
        printf "%s,%.5g,%.4g,", front[r], block[r], share
        if ((order[r], map[r]) in paper) {
            own = paper[order[r], map[r]]; whole = paper["scanline", map[r]]
            printf "%s,%.4g,%.3g", own, own / whole, share / (own / whole)
        } else printf ",,"
        print "," quoted(history[r])
    }
}
