# Puts the rows of several samples of one stream together as one row with the same columns; or, with -v until=0.01, prints
# how many windows are missing until the interval of fetches per query is as narrow as this share of it.
#   awk -f scripts/csv.awk -f scripts/until.awk round-1.csv round-2.csv ...
# Each file is what `pm-cachesim --format csv` prints of one trace of windows and one cache; the samples are independent.
#
# A number for each query is the mean of those of the samples, weighted by `queries_measured`; a number of the whole stream is
# weighted by `sample_share`. So weighted, standard errors add up as squares, degrees of freedom by Satterthwaite's formula, and
# doubt adds up as it is: half width = t(freedom) * error + doubt. Of other columns than fetches per query the half widths add
# up as squares. Windows and queries are summed.

# The 0.975 quantile of Student's t: Abramowitz and Stegun, Handbook of Mathematical Functions, 26.7.5.
function t(freedom,    x) {
    x = 1.959963985
    if (freedom + 0 < 2) return 12.7062
    return x + (x^3 + x) / 4 / freedom + (5*x^5 + 16*x^3 + 3*x) / 96 / freedom^2 \
        + (3*x^7 + 19*x^5 + 17*x^3 - 15*x) / 384 / freedom^3 \
        + (79*x^9 + 776*x^7 + 1482*x^5 - 1920*x^3 - 945*x) / 92160 / freedom^4
}

FNR == 1 { columns = split_line($0, names); for (i = 1; i <= columns; i++) at[names[i]] = i; next }

{ rows++; split_line($0, row); for (i = 1; i <= columns; i++) value[rows, i] = row[i] }

FNR > 2 { print "until.awk: " FILENAME " has rows of several caches; give one" > "/dev/stderr"; failed = 1; exit 1 }

function of(row, name) { return value[row, at[name]] }

# Weight of a sample for a column.
function weight(row, name) { return of(row, name ~ /_per_query|_per_search|_per_fetch/ ? "queries_measured" : "sample_share") }

END {
    if (failed) exit 1
    if (rows != ARGC - 1 || !("fetches_per_query_doubt" in at) || of(1, "windows") + 0 == 0) {
        print "until.awk: a table of a trace of windows is wanted in each file; is one empty?" > "/dev/stderr"
        exit 1
    }
    for (r = 1; r <= rows; r++) {
        queries += of(r, "queries_measured"); share += of(r, "sample_share"); windows += of(r, "windows")
    }
    for (r = 1; r <= rows; r++) {
        part = of(r, "queries_measured") / queries
        mean += part * of(r, "fetches_per_query"); doubt += part * of(r, "fetches_per_query_doubt")
        freedom = of(r, "degrees_of_freedom") + 0
        variance = (part * (of(r, "fetches_per_query_error") - of(r, "fetches_per_query_doubt")) / t(freedom))^2
        sum += variance
        if (freedom > 0) squares += variance^2 / freedom
    }
    freedom = squares > 0 ? sum^2 / squares : of(1, "degrees_of_freedom")
    chance = t(freedom) * sqrt(sum)
    if (until != "") {
        left = until * mean - doubt
        if (chance <= left) print 0
        else if (left <= 0) print "doubt"
        else {
            wanted = windows * (chance / left)^2 * 1.05
            more = int(wanted) + 1 - windows
            print more < 8 ? 8 : more
        }
        exit
    }
    if (people) {
        printf "%d windows, %d queries simulated: %.5g +- %.2g fetches per query (%.2f %%)\n", windows, total("queries_simulated"), \
            mean, chance + doubt, 100 * (chance + doubt) / mean
        exit
    }
    for (i = 1; i <= columns; i++) printf "%s%s", names[i], (i < columns ? "," : "\n")
    for (i = 1; i <= columns; i++) printf "%s%s", quoted(together(i)), (i < columns ? "," : "\n")
}

function total(name,    r, sum) { for (r = 1; r <= rows; r++) sum += of(r, name); return sum }

# What stands in a column of the one row.
function together(i,    r, name, base, sum, all) {
    name = names[i]
    if (name == "sample") { sum = value[1, i]; for (r = 2; r <= rows; r++) sum = sum " + " value[r, i]; return sum }
    if (name ~ /^(order|cache|lanes|cache_bytes|ways|line_bytes|policy|blocks|order_bytes_on_chip)$/) return value[1, i]
    if (name ~ /^(windows|windows_inexact|queries_measured|queries_simulated|sample_share)$/) return sprintf("%.15g", total(name))
    if (name == "fetches_per_query") return sprintf("%.15g", mean)
    if (name == "fetches_per_query_error") return sprintf("%.15g", chance + doubt)
    if (name == "fetches_per_query_doubt") return sprintf("%.15g", doubt)
    if (name == "degrees_of_freedom") return sprintf("%.15g", freedom)
    for (r = 1; r <= rows; r++) {
        if (value[r, i] == "") return ""
        all += weight(r, name)
    }
    for (r = 1; r <= rows; r++) {
        base = weight(r, name) / all * value[r, i]
        sum += (name ~ /_error$/) ? base^2 : base
    }
    if (name ~ /_error$/) sum = sqrt(sum)
    # Counts are whole numbers.
    return sprintf(value[1, i] ~ /^[0-9]+$/ ? "%.0f" : "%.15g", sum)
}
