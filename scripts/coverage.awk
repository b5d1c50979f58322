# Shows out/coverage.csv: widths, spreads and bias in percent of the truth. Fails if a row is missing, intervals hold the
# truth less often than in 93 of 100 samples, or are more than 1.3 times as wide as need be.

BEGIN { FS = "," }

NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }

NR == 2 {
    printf "%-14s %-6s %7s %9s %9s %10s %7s %7s %7s %9s %9s\n", "", "", "", "windows", "simulated", "", "mean", "in", \
        "", "", "width over"
    printf "%-14s %-6s %7s %9s %9s %10s %7s %7s %7s %9s %9s\n", "order", "rule", "truth", "", "share, %", "coverage, %", \
        "+-, %", "doubt", "bias, %", "spread, %", "t spread"
}

{
    rows++
    printf "%-14s %-6s %7.2f %9.1f %9.2f %11.1f %7.2f %7.2f %7.2f %9.2f %10.2f\n", $at["order"], $at["rule"], $at["truth"], \
        $at["windows"], 100 * $at["sampled_share"], 100 * $at["coverage"], 100 * $at["mean_half_width"], \
        100 * $at["mean_doubt"], 100 * $at["bias"], 100 * $at["spread"], $at["ratio"]
    if ($at["coverage"] < 0.93) bad = bad " " $at["order"] "/" $at["rule"] " (held too seldom)"
    if ($at["ratio"] > 1.3) bad = bad " " $at["order"] "/" $at["rule"] " (too wide)"
}

END {
    if (rows < 10) { print "coverage.awk: 10 rows are wanted, there are " rows + 0 > "/dev/stderr"; exit 1 }
    if (bad) { print "coverage.awk:" bad > "/dev/stderr"; exit 1 }
}
