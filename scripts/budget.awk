# The point with the fewest bytes on chip whose traffic fits a memory bandwidth:
#   awk -v budget=35 -v fps=1 -f scripts/budget.awk out/frontier/450000.csv
# `budget` is in GB/s, `fps` in frames a second.

BEGIN { FS = "," }

FNR == 1 { split("", at); for (i = 1; i <= NF; i++) at[$i] = i; file = FILENAME; best[file] = ""; order[++files] = file; next }

$at["total_bytes"] * fps <= budget * 1e9 && (best[file] == "" || $at["on_chip_bytes"] + 0 < least[file]) {
    least[file] = $at["on_chip_bytes"] + 0
    best[file] = sprintf("%s with a cache of %d bytes: %d bytes on chip, %.3f GB a frame", \
        $at["point"], $at["cache_bytes"], least[file], $at["total_bytes"] / 1e9)
}

END { for (i = 1; i <= files; i++) print order[i] ": " (best[order[i]] == "" ? "no point needs so little" : best[order[i]]) }
