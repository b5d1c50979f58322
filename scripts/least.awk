# The least traffic that bytes on chip buy, and the order that has it:
#   awk -f scripts/least.awk out/frontier/points.csv

BEGIN { FS = ","; sizes = split("256K 512K 1M 2M 4M 8M", name, " "); for (i = 1; i <= sizes; i++) bytes[i] = 131072 * 2 ^ i }

FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }

$at["series"] == "cache holds the map" { next }

{
    key = $at["photons"] SUBSEP $at["record"]
    if (!(key in seen)) {
        seen[key] = 1
        # Small maps first.
        for (i = ++number; i > 1 && keys[i - 1] + 0 > key + 0; i--) keys[i] = keys[i - 1]
        keys[i] = key
    }
    for (i = 1; i <= sizes; i++)
        if ($at["on_chip_bytes"] + 0 <= bytes[i] && (!((key, i) in least) || $at["total_bytes"] + 0 < least[key, i])) {
            least[key, i] = $at["total_bytes"] + 0
            order[key, i] = $at["point"]
        }
}

END {
    printf "Least traffic by all bytes on chip:\n%8s  %-8s %8s %9s  %s\n", "photons", "records", "on chip", "GB", "order"
    for (k = 1; k <= number; k++) {
        split(keys[k], part, SUBSEP)
        for (i = 1; i <= sizes; i++) if ((keys[k], i) in least)
            printf "%8s  %-8s %8s %9.3f  %s\n", part[1], part[2], name[i], least[keys[k], i] / 1e9, order[keys[k], i]
    }
}
