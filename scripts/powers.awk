# A million photons with random powers, as CSV, and (mean=1) the mean power of photons in CSV or as pm-view prints them:
#   awk -f scripts/powers.awk | pm-view --import photons - | pm-view --records | awk -v mean=1 -f scripts/powers.awk -
# Random numbers by Park and Miller's generator, which needs no more than exact integers below 2^47, so that every awk
# makes the same: Communications of the ACM 31, 1988, with the multiplier 48271 of their second thoughts.

function random() { seed = seed * 48271 % 2147483647; return seed / 2147483647 }

BEGIN {
    if (!mean) {
        seed = 20051
        print "x,y,z,power_r,power_g,power_b"
        for (i = 0; i < 1000000; i++) {
            # Six orders of magnitude, and channels that do not resemble one another.
            scale = exp((6 * random() - 3) * log(10))
            printf "%.6f,%.6f,%.6f", random(), random(), random()
            for (c = 0; c < 3; c++) printf ",%.9g", scale * random()
            print ""
        }
        exit
    }
}

NR == 1 {
    FS = index($0, "\t") ? "\t" : ","
    columns = split($0, names, FS)
    for (i = 1; i <= columns; i++) at[names[i]] = i
    next
}

{ r += $at["power_r"]; g += $at["power_g"]; b += $at["power_b"] }

END {
    if (!mean) exit
    if (NR < 2) exit 1
    print "name,r,g,b"
    printf "mean power,%.9g,%.9g,%.9g\n", r / (NR - 1), g / (NR - 1), b / (NR - 1)
}
