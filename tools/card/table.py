#!/usr/bin/env python3
"""What knn, the profiler and the pm programs said, compared and joined.

table.py start ANSWERS.csv                 the radius that searches start with
table.py compare KNN.jsonl ANSWERS.csv...  are the answers those of `pm-gather --report`? 1 if not
table.py join FOLDER RESULTS.csv PHOTONS...  all that was measured and foretold, a row for each search and order
"""

import csv
import json
import statistics
import sys
from pathlib import Path

# The map of pm-gather that a search is to be compared with, by the first word of its name.
MAPS = {"kd": "kd", "bucket": "bucket-kd"}
# How many of the searches' statistics are whole numbers when multiplied by the number of queries.
COUNTED = {"reads": "reads_per_query", "attempts": "attempts_per_query"}
QUANTILES = ["distance_p5", "distance_p50", "distance_p95", "distance_largest"]
# Column of results.csv, and metric of the profiler.
COUNTERS = {
    "profiled_seconds": "gpu__time_duration.sum",
    "dram_read_bytes": "dram__bytes_read.sum",
    "dram_written_bytes": "dram__bytes_write.sum",
    "l2_read_sectors": "lts__t_sectors_srcunit_tex_op_read.sum",
    "l2_missed_sectors": "lts__t_sectors_srcunit_tex_lookup_miss.sum",
    "l2_fabric_sectors": "lts__t_sectors_srcunit_ltcfabric.sum",
    "l1_requests": "l1tex__t_requests_pipe_lsu_mem_global_op_ld.sum",
    "l1_sectors": "l1tex__t_sectors_pipe_lsu_mem_global_op_ld.sum",
    "l1_hit_sectors": "l1tex__t_sectors_pipe_lsu_mem_global_op_ld_lookup_hit.sum",
    "local_read_sectors": "l1tex__t_sectors_pipe_lsu_mem_local_op_ld.sum",
    "local_written_sectors": "l1tex__t_sectors_pipe_lsu_mem_local_op_st.sum",
    "warp_instructions": "smsp__inst_executed.sum",
    "thread_instructions": "smsp__thread_inst_executed.sum",
    "warps_active_percent": "sm__warps_active.avg.pct_of_peak_sustained_active",
}


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def lines_of(path):
    return [json.loads(line) for line in Path(path).read_text().splitlines()]


def compare(results, answers):
    """Prints and returns how many searches differ from what pm-gather found with the same map."""
    known = {row["map"]: row for row in map(lambda path: rows_of(path)[0], answers)}
    wrong = compared = 0
    for result in lines_of(results):
        name = result["search"]
        row = known.get(MAPS.get(name.split("-")[0]))
        if row is None:
            continue
        compared += 1
        told = {"queries": int(row["queries"]), "photons": int(row["photons"]), "k": int(row["k"]), "truth_wrong": 0}
        told |= {ours: round(float(theirs) * told["queries"]) for ours, theirs in ((o, row[t]) for o, t in COUNTED.items())}
        told |= {name: float(row[name]) for name in QUANTILES}
        different = {key: (result[key], value) for key, value in told.items() if result[key] != value}
        mean = float(row["distance_mean"])
        # Sums in different orders.
        if abs(result["distance_mean"] - mean) > 1e-9 * mean:
            different["distance_mean"] = (result["distance_mean"], mean)
        if different:
            wrong += 1
            print(f"table.py: {name} over {result['queries_file']}: (card, pm-gather) {different}", file=sys.stderr)
    if compared == 0:
        print(f"table.py: {results}: no search to compare", file=sys.stderr)
        return 1
    print(f"{results}: {compared} searches compared with pm-gather, {wrong} differ")
    return wrong


def counters_of(path):
    """What the profiler counted, launch by launch."""
    rows = [line for line in Path(path).read_text().splitlines() if line.startswith('"')]
    # A row of units follows that of names.
    return list(csv.DictReader([rows[0], *rows[2:]]))


def foretold(folder, photons, order):
    """Columns that pm-cachesim foretells of the kd-tree, as far as they were made."""
    columns = {}
    for kind, name in [("l2", "foretold_l2"), ("flying", "foretold_l2_flying"), ("l1", "foretold_l1_flying")]:
        path = folder / "foretold" / f"{photons}.{order}.{kind}.csv"
        if path.exists():
            for row in rows_of(path):
                columns[f"{name}_bytes_{row['line_bytes']}"] = int(row["bytes_fetched"])
    return columns


# What knn says of a search, as columns of the same names.
SAID = ["photons", "search", "order", "queries", "k", "map_bytes", "registers", "local_bytes", "resident"]
FOUND = ["reads", "touches", "attempts", "digest", "card", "cuda_driver", "cuda_runtime", "l2_bytes"]


def row_of(line, launch):
    """A row of results from what knn and the profiler said of a search; what was not measured stays empty."""
    row = {key: line.get(key, "") for key in SAID}
    if seconds := line.get("seconds"):
        row |= {"runs": len(seconds), "seconds_median": statistics.median(seconds)}
        row |= {"seconds_least": min(seconds), "seconds_most": max(seconds)}
    row |= {key: line.get(key, "") for key in FOUND}
    for column, metric in COUNTERS.items():
        if launch.get(metric):
            number = float(launch[metric].replace(",", ""))
            row[column] = number / 1e9 if column == "profiled_seconds" else int(number) if number.is_integer() else number
    return row


def join(folder, output, photon_counts):
    rows = []
    for photons in photon_counts:
        lines = [folder / f"{kind}-{photons}.jsonl" for kind in ["times", "profiled"]]
        times, profiled = (lines_of(path) if path.exists() else [] for path in lines)
        launches = counters_of(folder / f"counters-{photons}.csv") if profiled else []
        if len(launches) != len(profiled):
            sys.exit(f"table.py: counters-{photons}.csv: {len(launches)} launches, where knn made {len(profiled)}; profile again")
        counted = {(line["search"], line["queries_file"]): launch for line, launch in zip(profiled, launches)}
        for line in times or profiled:
            order = Path(line["queries_file"]).stem.removesuffix(f"-{photons}")
            row = row_of(line | {"order": order}, counted.get((line["search"], line["queries_file"]), {}))
            rows.append(row | (foretold(folder, photons, order) if line["search"].startswith("kd") else {}))
    columns = list(dict.fromkeys(column for row in rows for column in row))
    with open(output, "w", newline="") as file:
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def main():
    match sys.argv[1:]:
        case ["start", answers]:
            print(rows_of(answers)[0]["start_radius"])
        case ["compare", results, *answers] if answers:
            sys.exit(1 if compare(results, answers) else 0)
        case ["join", folder, output, *photons] if photons:
            join(Path(folder), output, photons)
        case _:
            print(__doc__, file=sys.stderr)
            sys.exit(2)


if __name__ == "__main__":
    main()
