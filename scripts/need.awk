# Of out/need.csv: for each error, the cheapest point in seconds, and in bytes by both orders.
NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
{ n++; for (name in at) row[n, name] = $at[name] }
function cheapest(wanted, by,   i, best) {
    for (i = 1; i <= n; i++)
        if (row[i, "error"] <= wanted && (!best || row[i, by] + 0 < row[best, by] + 0)) best = i
    if (!best) { printf "%-10s %-22s none of these\n", 100 * wanted "%", by; return }
    printf "%-10s %-22s %12.4g   %6d photons, k %d, %d x %d rays: error %.2f%%, %.4g s\n", 100 * wanted "%", by, row[best, by],
        row[best, "photons_of_map"], row[best, "neighbours"], row[best, "samples"], row[best, "gathers"], 100 * row[best, "error"],
        row[best, "seconds"]
}
END {
    split("0.1 0.05 0.03 0.02", wanted, " ")
    for (w = 1; w <= 4; w++) {
        cheapest(wanted[w], "seconds"); cheapest(wanted[w], "scanline_bytes"); cheapest(wanted[w], "tiled_hilbert_bytes")
    }
}
