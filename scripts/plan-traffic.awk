# Sums up out/plan-traffic.csv: in how many runs the bytes of the whole were within the interval foretold, and how wide that was.
NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
$at["runs"] == 0 { refused++; next }
{
    n = $at["runs"]; runs += n; kept += $at["kept"]; below += $at["below"]; above += $at["above"]
    off += n * $at["off"]; width += n * $at["width"]
    printf "%-16s %3s%%  on chip %5s  within in %2d of %d  off by %5.1f%%, the interval +-%5.1f%%  %.4g MB\n", $at["room"], $at["wanted"],
        $at["on_chip"], $at["kept"], n, 100 * $at["off"], 100 * $at["width"], $at["bytes_fetched"] / 1e6
}
END {
    if (runs == 0) { print "No plan was made."; exit }
    printf "within in %d of %d runs (%.1f%%), less in %d, more in %d; off by %.1f%% in the mean, intervals +-%.1f%%; %d points refused\n",
        kept, runs, 100 * kept / runs, below, above, 100 * off / runs, 100 * width / runs, refused
}
