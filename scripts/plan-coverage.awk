# Sums up out/plans.csv: how many runs had at most the error that was wanted, in all and by room, and how far predictions were off.
NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
$at["runs"] == 0 { refused++; next }
{
    runs += $at["runs"]; kept += $at["kept"]
    of_room[$at["room"]] += $at["runs"]; kept_of_room[$at["room"]] += $at["kept"]
    off = $at["planned_error"] / $at["true_error"] - 1
    apart[++n] = off < 0 ? -off : off
    printf "%-16s %3s%%  planned %5.2f%%  true %5.2f%%  worst %5.2f%%  kept %2d of %d  %.4g s, planning %.4g s\n", $at["room"],
        $at["wanted"], 100 * $at["planned_error"], 100 * $at["true_error"], 100 * $at["worst_error"], $at["kept"], $at["runs"],
        $at["true_seconds"], $at["planning_seconds"]
}
END {
    for (i = 2; i <= n; i++)
        for (j = i; j > 1 && apart[j] < apart[j - 1]; j--) { x = apart[j]; apart[j] = apart[j - 1]; apart[j - 1] = x }
    for (room in of_room) {
        share = kept_of_room[room] / of_room[room]
        if (worst == "" || share < lowest) { lowest = share; worst = room }
    }
    if (runs == 0) { print "No plan was made."; exit }
    printf "kept in %d of %d runs (%.1f%%); least in %s (%.0f%%); predictions off by %.0f%% in the median; %d plans refused\n",
        kept, runs, 100 * kept / runs, worst, 100 * lowest, 100 * apart[int((n + 1) / 2)], refused
}
