# Sets the orders beside each other and beside the paper:
#   awk -v tiles=64 -v rays=1048576 -f scripts/compare.awk scripts/paper.csv out/scanline.csv out/hilbert.csv ...
# The first file holds the paper's figures, the others are what `pm-cachesim --format csv` prints, named after the order, or
# a table of such rows with a column `point`. Of several caches the paper's own counts, of 128 KiB.
# `tiles` is the number of 16 x 16 tiles of the image, `rays` the number of gather rays cast.
#
# The paper: Steinhurst, Coombe, Lastra, Reordering for Cache Conscious Photon Mapping, GI 2005. Its fetches per query
# are 196 GB (or GiB) over 128 bytes and 512 x 512 x 100 rays; its fetches per block and tile are Table 1 over 1,024.

BEGIN { FS = "," }

FNR == 1 { file++; split("", at) }

file == 1 { if (FNR > 1) { unit[$1] = $2; paper[$1] = $3 } next }

# Commas inside quotes are no separators.
{ gsub(/"[^"]*"/, "text") }

FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }

$at["cache_bytes"] != 131072 { next }

{
    name = FILENAME
    sub(/.*\//, "", name); sub(/\.csv$/, "", name)
    if ("point" in at) name = $at["point"]
    if (FILENAME != counted) { counted = FILENAME; files++ }
    if (!printed++) {
        printf "%-18s %9s %9s %11s %12s %12s\n", "", "reads", "fetches", "fetches", "", "share of"
        printf "%-18s %9s %9s %11s %12s %12s   %-34s %s\n", "order", "per query", "per query", "per block", "MB", \
            "scanline", "in the paper's unit", "paper"
    }
    queries = $at["queries"]; fetches = $at["fetches"]; mb = $at["bytes_fetched"] / 1e6
    if (name == "scanline") { whole = mb; whole_fetches = fetches }
    base = name; sub(/-(inf|preorder|reread)$/, "", base)
    own = ""
    u = unit[base]
    if (u == "" && base == "random") u = "fetches per query"
    if (u == "" && base == "tiled") u = "fetches per block and tile"
    if (u == "fetches per query") own = sprintf("%.1f %s", $at["fetches_per_query"], u)
    if (u == "fetches per block") own = sprintf("%.2f %s", $at["fetches_per_block"], u)
    if (u == "fetches per block and tile") own = sprintf("%.2f %s", $at["fetches_per_block"] / tiles, u)
    share = "-"
    if (whole) share = (2 * mb < whole) ? sprintf("1/%.1f", whole / mb) : sprintf("%.3f", mb / whole)
    printf "%-18s %9.1f %9.3f %11.2f %12.1f %12s   %-34s %s\n", name, $at["reads_per_query"], $at["fetches_per_query"], \
        $at["fetches_per_block"], mb, share, own, (base in paper) ? paper[base] : "-"
}

END {
    # A row that is missing means a command that did not do its work, whatever exit code it gave.
    if (files != ARGC - 2) {
        print "compare.awk: " (ARGC - 2) " results are wanted, " (files + 0) " have a row; remove the empty ones and run again" > "/dev/stderr"
        exit 1
    }
    if (queries && rays) {
        printf "\n%d queries of %d gather rays: the others left through the open front or met only black surfaces.\n", queries, rays
        if (whole_fetches) printf "The paper divides by all rays; so divided scanline has %.1f fetches.\n", whole_fetches / rays
    }
}
