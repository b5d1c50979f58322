# A table of sweeps with nothing cut into windows and nothing thinned:
#   awk -f scripts/exact.awk scripts/sweeps/table1.csv

# What is about samples stays as it is.
FILENAME ~ /(convergence|failures|frontier|sampling|structures)[.]csv$/ { print; next }

{
    gsub(/ [|][|] /, " | ")
    gsub(/ --only-tiles [0-9]+/, ""); gsub(/ --window [0-9]+/, ""); gsub(/ --warm-up ([0-9]+|[{]setting[}])/, "")
    gsub(/ [|] pm-sample -q --(every|queries|batches) ([0-9]+|[{]m[}])/, "")
    gsub(/,(sampled|thinned),/, ",full,")
    gsub(/,1\/64,/, ",1,")
    gsub(/--size 90x90/, "--size 512x512")
    print
}
