# How wide the intervals of sampled rows are and how far they are from the row in full, both in percent, by the share of the
# searches that are simulated:
#   awk -f scripts/csv.awk -f scripts/sampled.awk out/sampling.csv

{ cells = split_line($0, cell) }

NR == 1 {
    for (i = 1; i <= cells; i++) at[cell[i]] = i
    print "order,what,every,share_simulated,percent"
    next
}

cell[at["found"]] == "full" {
    full[cell[at["order"]]] = cell[at["fetches_per_query"]]
    queries[cell[at["order"]]] = cell[at["queries"]]
    next
}

{
    order = cell[at["order"]]
    if (!(order in full)) { print "sampled.awk: the row in full of " order " has to come first" > "/dev/stderr"; exit 1 }
    found = cell[at["fetches_per_query"]]
    front = order ",%s," cell[at["every"]] "," cell[at["queries_simulated"]] / queries[order] ",%.4g\n"
    printf front, "interval", 100 * cell[at["fetches_per_query_error"]] / found
    printf front, "error", 100 * (found > full[order] ? found - full[order] : full[order] - found) / full[order]
}
