# Of out/need.csv and out/need-plans.csv: for each error, the cheapest point of the grid in seconds, and in bytes by both orders; the
# paper's map, 450,000 photons and k = 100, with as few rays as do; and what pm-plan chose, which saves seconds.
FNR == 1 { file++; for (i = 1; i <= NF; i++) at[file, $i] = i; fields = NF; next }
{
    n++
    for (name in known) row[n, name] = $at[file, name]
    planned[n] = file == 2
    if (planned[n]) of_plan[$at[2, "wanted"] / 100] = n
}
BEGIN { split("seconds scanline_bytes tiled_hilbert_bytes photons_of_map neighbours samples gathers error", names, " "); for (i in names) known[names[i]] }
function is_papers(i) { return row[i, "photons_of_map"] == 450000 && row[i, "neighbours"] == 100 }
function cheapest(wanted, by, papers,   i, best) {
    for (i = 1; i <= n; i++)
        if (!planned[i] && is_papers(i) == papers && row[i, "error"] + 0 <= wanted && (!best || row[i, by] + 0 < row[best, by] + 0)) best = i
    return best
}
function told(wanted, what, i, by, beside) {
    if (!i) { printf "%-8s %-30s none of these\n", 100 * wanted "%", what; return }
    printf "%-8s %-30s %10.4g %7s   %6d photons, k %3d, %4d x %d rays: error %.2f%%, %.4g s\n", 100 * wanted "%", what, row[i, by],
        beside ? sprintf("%.2f x", row[i, by] / row[beside, by]) : "", row[i, "photons_of_map"], row[i, "neighbours"], row[i, "samples"],
        row[i, "gathers"], 100 * row[i, "error"], row[i, "seconds"]
}
END {
    split("0.1 0.05 0.03 0.02", wanted, " ")
    for (w = 1; w <= 4; w++) {
        e = wanted[w]
        for (b = 1; b <= 3; b++) {
            by = names[b]
            least = cheapest(e, by, 0)
            told(e, by, least, by, 0)
            told(e, "  the paper's map", cheapest(e, by, 1), by, least)
            told(e, "  pm-plan", of_plan[e], by, least)
        }
    }
}
