# All traffic of the orders, with the paper's cache of 128 KiB:
#   awk -f scripts/csv.awk -f scripts/traffic.awk out/full.csv

{ cells = split_line($0, cell) }

NR == 1 { for (i = 1; i <= cells; i++) at[cell[i]] = i; next }

cell[at["cache_bytes"]] != 131072 { next }

{
    total = cell[at["total_bytes"]] + 0
    if (!printed++) {
        printf "\n%-18s %11s %11s %11s %11s %11s %9s\n", "", "order, MB", "", "queries,", "", "", "share of"
        printf "%-18s %11s %11s %11s %11s %11s %9s\n", "order", "on chip", "map, GB", "GB", "results, GB", "total, GB", "scanline"
        first = total
    }
    printf "%-18s %11.3f %11.3f %11.3f %11.3f %11.3f %9s\n", cell[at["point"]], cell[at["order_bytes_on_chip"]] / 1e6, \
        (cell[at["bytes_fetched"]] + cell[at["bytes_written_back"]]) / 1e9, cell[at["query_bytes"]] / 1e9, \
        cell[at["result_bytes"]] / 1e9, total / 1e9, 2 * total < first ? sprintf("1/%.1f", first / total) : sprintf("%.3f", total / first)
}
