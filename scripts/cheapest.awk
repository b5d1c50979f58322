# For an error of at most so much, the setting that takes the fewest seconds and the one that fetches the fewest bytes:
#   awk -f scripts/cheapest.awk out/pictures.csv

BEGIN { FS = ","; n = split("0.03 0.01 0.003 0.001 0.0003", limit, " "); print "rel_mse_at_most,by,method,setting,n,k,gathers,seconds,bytes_fetched,rel_mse,ldr_flip" }

{ gsub(/"[^"]*"/, "text") }
FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }

{
    for (l = 1; l <= n; l++) if ($at["rel_mse"] + 0 <= limit[l] + 0) {
        consider("seconds", $at["seconds"]); consider("bytes", $at["bytes_fetched"])
    }
}

function consider(by, cost) {
    if ((l, by) in least && least[l, by] <= cost + 0) return
    least[l, by] = cost + 0
    best[l, by] = $at["method"] "," $at["setting"] "," $at["n"] "," $at["k"] "," $at["gathers"] "," $at["seconds"] "," \
        $at["bytes_fetched"] "," $at["rel_mse"] "," $at["ldr_flip"]
}

END { for (l = 1; l <= n; l++) { row("seconds"); row("bytes") } }
function row(by) { print limit[l] "," by "," (((l, by) in best) ? best[l, by] : "none of those tried,,,,,,,,") }
