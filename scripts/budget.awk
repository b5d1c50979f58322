# The point with the fewest bytes on chip whose traffic fits a memory bandwidth, for each number of photons:
#   awk -v budget=35 -v fps=1 -f scripts/budget.awk out/frontier/points.csv
# `budget` is in GB/s, `fps` in frames a second.

BEGIN { FS = "," }

FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }

{ photons = $at["photons"]; if (!(photons in best)) { order[++maps] = photons; best[photons] = "" } }

$at["series"] != "cache holds the map" && $at["total_bytes"] * fps <= budget * 1e9 && (best[photons] == "" || $at["on_chip_bytes"] + 0 < least[photons]) {
    least[photons] = $at["on_chip_bytes"] + 0
    best[photons] = sprintf("%s, %s records, a cache of %d bytes: %d bytes on chip, %.3f GB a frame", \
        $at["point"], $at["record"], $at["cache_bytes"], least[photons], $at["total_bytes"] / 1e9)
}

END { for (i = 1; i <= maps; i++) print order[i] " photons: " (best[order[i]] == "" ? "no point needs so little" : best[order[i]]) }
