# Means of rows of the same name over files that hold independent repetitions, and their standard errors:
#   awk -f scripts/batches.awk out/accuracy/flux-1.csv out/accuracy/flux-2.csv ...
# Rows are name,r,g,b, or what `pm-view --mean --format csv` prints, named by their rectangles.

BEGIN { FS = "," }

FNR == 1 { split("", at); for (i = 1; i <= NF; i++) at[$i] = i; next }

{
    name = ("name" in at) ? $at["name"] : $at["x0"] " " $at["y0"] " " $at["x1"] " " $at["y1"]
    if (!(name in n)) names[++count] = name
    n[name]++
    value[2] = $at["r"]; value[3] = $at["g"]; value[4] = $at["b"]
    for (c = 2; c <= 4; c++) { sum[name, c] += value[c]; square[name, c] += value[c] * value[c] }
}

END {
    print "name,r,g,b,se_r,se_g,se_b"
    for (i = 1; i <= count; i++) {
        name = names[i]; k = n[name]
        if (k < 2) exit 1
        printf "%s", name
        for (c = 2; c <= 4; c++) printf ",%.9g", sum[name, c] / k
        for (c = 2; c <= 4; c++) {
            variance = (square[name, c] - sum[name, c] ^ 2 / k) / (k - 1)
            printf ",%.6g", sqrt(variance > 0 ? variance / k : 0)
        }
        print ""
    }
}
