//! Is a page whole: valid HTML that needs nothing else, every chart there, every number from the tables?

use crate::support::Folder;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use scraper::{ElementRef, Html, Selector};
use std::collections::BTreeSet;
use std::process::Command;

const PAGE: &str = r##"title = "Caches & <orders>"
folder = "tables"
command = "make tables"
intro = """
Scanline fetches {{ scan / hilbert | .2f }} times as much, {{ scan | , }} lines; [the table](#beside) has more, and so has
[the paper](https://example.org/paper.pdf). A <script>alert(1)</script> is text.
"""

[numbers]
scan = "row('sizes.csv', order='scanline', cache_bytes=1024).fetches"
hilbert = "row('sizes.csv', order='scanline, hilbert', cache_bytes=1024).fetches"

[[section]]
heading = "Sizes"
text = "# Within\n\n| order | fetches |\n| --- | ---: |\n| scanline | {{ scan }} |"

[[section.chart]]
title = "Fetches against size"
tables = ["sizes.csv"]
reference = ["paper.csv"]
x = "cache_bytes"
y = "fetches"
by = ["order"]

[[section.paragraph]]
heading = "Between"
text = "A sampled number: {{ row('sampled.csv', order='scanline').fetches | .1f }}."

[[section.chart]]
tables = ["sampled.csv"]
x = "order"
y = "fetches"
error = "half_width"
points = true
command = "pm-sample --help"

[[section]]
heading = "Sizes"

[[section.table]]
title = "Beside the paper"
id = "beside"
tables = ["sizes.csv"]
only = { cache_bytes = ["1024", "4096"] }
sort = ["-cache_bytes", "order"]
join = [{ name = "paper", table = "paper.csv", on = ["cache_bytes"] }]
columns = [
    "order",
    { column = "cache_bytes", heading = "cache", format = "B" },
    { column = "fetches_per_query", format = ".3g" },
    { ratio = ["fetches", "paper.fetches"], heading = "ratio", format = ".2f" },
]

[[section.table]]
tables = ["sampled.csv"]
columns = [{ column = "fetches", format = ".1f", error = "half_width" }]

[[section.picture]]
file = "picture.png"
alt = 'A "picture"'
caption = "It is *the same* for every order."
"##;

const SAMPLED: &str = "order,fetches,half_width,found\nscanline,50.04,1.5,sampled\nhilbert,2.02,,full\n";
const PAPER: &str = "cache_bytes,fetches\n1024,10000\n16384,1000\n";

/// A folder with `page.toml` and, in `tables`, what it names.
fn folder() -> Folder {
    let folder = Folder::with_streams();
    std::fs::create_dir(folder.path("tables")).expect("a folder");
    folder.run("pm-reorder hilbert q.pmq -o h.pmq").ok();
    folder.run("pm-gather map.pmp h.pmq -o h.pmt --image tables/picture.png").ok();
    folder.run("pm-gather map.pmp q.pmq -o q.pmt").ok();
    let csv = folder.run("pm-cachesim q.pmt h.pmt --sizes 1K,4K,16K --format csv").ok().stdout;
    folder.write("tables/sizes.csv", csv);
    folder.write("tables/sampled.csv", SAMPLED);
    folder.write("tables/paper.csv", PAPER);
    folder.write("page.toml", PAGE);
    folder
}

fn page(folder: &Folder) -> String {
    folder.run("pm-chart --page page.toml -o page.html").ok();
    String::from_utf8(folder.read("page.html")).expect("text")
}

fn all<'a>(html: &'a Html, selector: &str) -> Vec<ElementRef<'a>> {
    html.select(&Selector::parse(selector).expect("a selector")).collect()
}

fn text(element: &ElementRef<'_>) -> String {
    element.text().collect::<String>().trim().to_owned()
}

/// What is wrong with a page by itself: parse errors, links that lead nowhere or out, names that are there twice.
fn faults(text: &str) -> Vec<String> {
    let html = Html::parse_document(text);
    let mut faults: Vec<String> = html.errors.iter().map(ToString::to_string).collect();
    let mut ids = BTreeSet::new();
    for element in all(&html, "[id]") {
        let id = element.attr("id").expect("an id");
        if !ids.insert(id) {
            faults.push(format!("id {id} twice"));
        }
    }
    for element in all(&html, "*") {
        for (name, value) in element.value().attrs() {
            let inside = match name {
                "href" => {
                    value.starts_with("data:text/csv;") || value.strip_prefix('#').is_some_and(|id| ids.contains(id))
                }
                "src" => value.starts_with("data:image/png;"),
                "action" | "background" | "data" | "poster" | "srcset" | "xlink:href" => false,
                _ => !name.starts_with("on") && !value.contains("url("),
            };
            if !inside {
                faults.push(format!("{name}={value:.60}"));
            }
        }
    }
    if !all(&html, "script, link, iframe, object, embed, base, form").is_empty() {
        faults.push("an element that has no place here".to_owned());
    }
    for style in all(&html, "style") {
        let style = style.text().collect::<String>();
        if style.contains("url(") || style.contains("@import") || style.contains("http") {
            faults.push("a style that loads".to_owned());
        }
    }
    for (what, selector) in [
        ("a picture without alt", "img:not([alt]), img[alt='']"),
        ("a drawing without title", "figure.chart > svg:not(:has(> title))"),
        ("a heading of a table without scope", "th:not([scope])"),
    ] {
        if !all(&html, selector).is_empty() {
            faults.push(what.to_owned());
        }
    }
    faults
}

fn decoded(uri: &str) -> Vec<u8> {
    STANDARD.decode(uri.split_once("base64,").expect("base64").1).expect("base64")
}

#[test]
fn a_page_is_valid_and_needs_nothing_else() {
    let folder = folder();
    let text = page(&folder);
    assert_eq!(faults(&text), Vec::<String>::new());
    // The test sees what it is to see.
    for (from, to) in [
        ("</figure>", ""),
        ("href=\"#beside\"", "href=\"#aside\""),
        ("href=\"#beside\"", "href=\"https://example.org\""),
        ("<h1>", "<img src=\"a.png\" alt=\"a\"><h1>"),
        ("<h1>", "<h1 id=\"beside\">"),
        ("<p>", "<p><div>"),
    ] {
        assert!(text.contains(from) && !faults(&text.replacen(from, to, 1)).is_empty(), "{from} {to}");
    }
    assert_eq!(text, page(&folder), "the same tables, the same page");
}

#[test]
fn every_number_is_one_of_the_tables() {
    let folder = folder();
    let html = Html::parse_document(&page(&folder));
    let csv = String::from_utf8(folder.read("tables/sizes.csv")).expect("text");
    let mut table = csv::Reader::from_reader(csv.as_bytes());
    let names = table.headers().expect("names").clone();
    let rows: Vec<csv::StringRecord> = table.records().map(|row| row.expect("a row")).collect();
    let of = |row: &csv::StringRecord, name: &str| {
        row[names.iter().position(|known| known == name).expect("the column")].to_owned()
    };
    let find = |order: &str, size: &str| {
        rows.iter().find(|row| of(row, "order") == order && of(row, "cache_bytes") == size).expect("the row")
    };
    let number = |row: &csv::StringRecord, name: &str| of(row, name).parse::<f64>().expect("a number");

    let (scan, hilbert) = (find("scanline", "1024"), find("scanline, hilbert", "1024"));
    let numbers: Vec<String> =
        all(&html, "header .number, section p .number, section td .number").iter().map(text).collect();
    let fetches = of(scan, "fetches");
    let at = fetches.len() - 3;
    assert_eq!(
        numbers,
        [
            format!("{:.2}", number(scan, "fetches") / number(hilbert, "fetches")),
            // Between a thousand and a million.
            format!("{},{}", &fetches[..at], &fetches[at..]),
            fetches.clone(),
            "50.0".to_owned()
        ]
    );
    assert_eq!(all(&html, ".found").iter().map(text).collect::<Vec<_>>(), ["(sampled)"]);

    let cells = |table: &ElementRef<'_>| -> Vec<Vec<String>> {
        let row = Selector::parse("tbody tr").expect("a selector");
        let cell = Selector::parse("th, td").expect("a selector");
        table.select(&row).map(|row| row.select(&cell).map(|cell| text(&cell)).collect()).collect()
    };
    let tables = all(&html, "figure.table table");
    let expected: Vec<Vec<String>> = [("4096", "4K"), ("1024", "1K")]
        .into_iter()
        .flat_map(|size| [(size, "scanline"), (size, "scanline, hilbert")])
        .map(|((bytes, size), order)| {
            let row = find(order, bytes);
            let ratio = if bytes == "1024" { format!("{:.2}", number(row, "fetches") / 1e4) } else { "–".into() };
            let shown: f64 = format!("{:.2e}", number(row, "fetches_per_query")).parse().expect("a number");
            vec![order.to_owned(), size.to_owned(), shown.to_string(), ratio]
        })
        .collect();
    let mut found = cells(&tables[0]);
    // Three digits, whatever zeros stand behind them.
    found.iter_mut().for_each(|row| row[2] = row[2].parse::<f64>().expect("a number").to_string());
    assert_eq!(found, expected);
    assert_eq!(cells(&tables[1]), [["50.0 ± 1.5", "sampled"], ["2.0", "full"]]);

    // The data below the charts are the tables' own, and so is the picture.
    let links = all(&html, "figure a[download]");
    assert_eq!(
        links.iter().map(|a| a.attr("download").unwrap()).collect::<Vec<_>>(),
        ["sizes.csv", "sampled.csv", "sizes.csv", "sampled.csv"]
    );
    let data = String::from_utf8(decoded(links[0].attr("href").unwrap())).expect("text");
    let mut lines: Vec<String> = vec!["table,order,cache_bytes,fetches".into()];
    for row in &rows {
        let order = if of(row, "order").contains(',') { format!("\"{}\"", of(row, "order")) } else { of(row, "order") };
        lines.push(format!("sizes.csv,{order},{},{}", of(row, "cache_bytes"), of(row, "fetches")));
    }
    lines.extend(["paper.csv,,1024,10000".into(), "paper.csv,,16384,1000".into()]);
    assert_eq!(data.lines().collect::<Vec<_>>(), lines);
    let sampled = String::from_utf8(decoded(links[1].attr("href").unwrap())).expect("text");
    assert_eq!(sampled, SAMPLED);
    assert_eq!(decoded(all(&html, "img")[0].attr("src").unwrap()), folder.read("tables/picture.png"));

    // Every row's history, each once, and the nearest command.
    let told: BTreeSet<String> = all(&html, "figure.chart .history code").iter().map(text).collect();
    assert_eq!(told, rows.iter().map(|row| of(row, "history")).collect());
    let made: Vec<String> = all(&html, ".made code").iter().map(text).collect();
    assert_eq!(made, ["make tables", "pm-sample --help", "make tables", "make tables", "make tables"]);
}

#[test]
fn charts_are_drawn_wide_and_narrow_with_a_mark_for_each_row() {
    let folder = folder();
    let html = Html::parse_document(&page(&folder));
    let charts = all(&html, "figure.chart");
    assert_eq!(charts.len(), 2);
    for class in ["wide", "narrow"] {
        let drawn = all(&html, &format!("figure.chart > svg.{class}[role=img]"));
        assert_eq!(drawn.len(), 2, "{class}");
        // Three sizes in two orders, and two points of the paper; two points, of which one has an interval.
        let marks = |chart: &ElementRef<'_>, what: &str| chart.select(&Selector::parse(what).unwrap()).count();
        assert_eq!((marks(&drawn[0], "circle"), marks(&drawn[0], "rect[fill='#D55E00']")), (3 + 2, 3));
        assert_eq!(marks(&drawn[1], "circle"), 2);
    }
    let titles: Vec<String> = all(&html, "svg.wide > title").iter().map(text).collect();
    assert_eq!(titles, ["Fetches against size", "fetches against order"]);
    let legend: Vec<String> = all(&html, ".legend li").iter().map(text).collect();
    assert_eq!(legend, ["scanline", "scanline, hilbert", "paper"]);
    let headings: Vec<String> = all(&html, "h1, h2, h3, h4").iter().map(text).collect();
    assert_eq!(headings, ["Caches & <orders>", "Sizes", "Within", "Between", "Sizes"]);
    let contents: Vec<_> = all(&html, "nav a").iter().map(|a| a.attr("href").unwrap().to_owned()).collect();
    assert_eq!(contents, ["#sizes", "#sizes-2"]);
}

#[test]
fn a_chart_becomes_a_page_by_its_name() {
    let folder = folder();
    let line = "pm-chart -x cache_bytes -y fetches --by order --only cache_bytes=1024 --only cache_bytes=4096";
    folder.run(&format!("{line} --title Fetches tables/sizes.csv --reference tables/paper.csv -o chart.html")).ok();
    let text = String::from_utf8(folder.read("chart.html")).expect("text");
    assert_eq!(faults(&text), Vec::<String>::new());
    let html = Html::parse_document(&text);
    assert_eq!((all(&html, "figure.chart").len(), all(&html, "tbody tr").len()), (1, 4));
    assert_eq!(all(&html, "h1, h2").iter().map(self::text).collect::<Vec<_>>(), ["Fetches"]);
    let piped = folder.feed(&format!("{line} -o piped.html"), &folder.read("tables/sizes.csv")).ok();
    assert!(piped.stdout.is_empty());
    let piped = String::from_utf8(folder.read("piped.html")).expect("text");
    assert_eq!(faults(&piped), Vec::<String>::new());
    assert!(piped.contains("<h1>fetches against cache bytes</h1>"));
}

#[test]
fn what_is_not_there_is_said_with_its_line_and_nothing_is_written() {
    let folder = folder();
    for (from, to, code, hint) in [
        (
            "cache_bytes=1024).fetches\"",
            "cache_bytes=7).fetches\"",
            2,
            "page.toml, line 10: in {{ scan / hilbert | .2f }}",
        ),
        (
            "tables = [\"sampled.csv\"]\nx",
            "tables = [\"lost.csv\"]\nx",
            1,
            "page.toml, line 29: lost.csv: No such file",
        ),
        ("y = \"fetches\"\nby", "y = \"fetch\"\nby", 2, "line 17: sizes.csv: there is no column `fetch`"),
        ("x = \"order\"", "xx = \"order\"", 2, "line 31: unknown field `xx`"),
        ("\".3g\"", "\"3g\"", 2, "line 40: `3g` is not a format"),
        (
            "\"1024\", \"4096\"",
            "\"1024\", \"4097\"",
            2,
            "line 40: sizes.csv: no row is left with `4097` in cache_bytes",
        ),
        ("(#beside)", "(#aside)", 2, "there is nothing called #aside on the page"),
        ("picture.png", "paper.csv", 1, "paper.csv: this is not a PNG file"),
        ("alt = 'A \"picture\"'", "alt = ' '", 2, "`alt` says"),
        ("{{ scan }}", "{{ scan", 2, "line 13: `{{ scan"),
        ("id = \"beside\"", "id = \"sizes picture\"", 2, "line 40: `sizes picture` as an id"),
        ("title = \"Caches", "titel = \"Caches", 2, "line 1: "),
    ] {
        assert!(PAGE.contains(from), "{from}");
        folder.write("page.toml", PAGE.replacen(from, to, 1));
        let outcome = folder.run("pm-chart --page page.toml -o page.html");
        assert!(outcome.fails(code).contains(hint), "{to}: {}", outcome.stderr);
        assert!(!folder.names().contains(&"page.html".to_owned()), "{to}");
    }
    let outcome = folder.run("pm-chart --page none.toml -o page.html");
    assert!(outcome.fails(1).contains("none.toml"), "{}", outcome.stderr);
    let outcome = folder.run("pm-chart --page page.toml -x a -y b");
    assert!(outcome.code == 2 && outcome.stderr.contains("--page"), "{}", outcome.stderr);
}

#[test]
fn a_page_reads_its_own_folder_only() {
    let folder = Folder::new();
    std::fs::create_dir_all(folder.path("pages/own")).unwrap();
    folder.write("secret.csv", "a,b\n1,2\n");
    folder.write("pages/own/open.csv", "a,b\n1,2\n");
    std::os::unix::fs::symlink("../../secret.csv", folder.path("pages/own/link.csv")).unwrap();
    for (table, inside) in [
        ("open.csv", true),
        ("../own/open.csv", true),
        ("../../secret.csv", false),
        ("link.csv", false),
        ("/dev/null", false),
    ] {
        let page = format!(
            "title = 'A'\nfolder = 'own'\n\n[[section]]\nheading = 'B'\n\n[[section.table]]\ntables = ['{table}']\n"
        );
        folder.write("pages/page.toml", page);
        let line = "pm-chart --page pages/page.toml -o page.html";
        let outcome = folder.run(line);
        if inside {
            assert_eq!(outcome.code, 0, "{table}: {}", outcome.stderr);
        } else {
            assert!(outcome.fails(2).contains("outside the folder of the page"), "{table}: {}", outcome.stderr);
            assert!(!folder.names().contains(&"page.html".to_owned()));
            let anyway = folder.run(&format!("{line} --anyway"));
            assert!(anyway.code == 0 || table == "/dev/null", "{table}: {}", anyway.stderr);
        }
        let _ = std::fs::remove_file(folder.path("page.html"));
    }
    assert_eq!(folder.run("pm-chart --anyway -x a -y b secret.csv").code, 2, "an option that does nothing");
}

/// Measures a page in a browser: how many charts, in how many of them just one drawing is seen and within the width, and
/// whether the page is wider than the window.
const MEASURE: &str = "<script>addEventListener('load', () => {
  const charts = [...document.querySelectorAll('figure.chart')];
  const seen = charts.filter(chart => {
    const drawn = [...chart.querySelectorAll(':scope > svg')].map(svg => svg.getBoundingClientRect());
    const shown = drawn.filter(box => box.width > 300 && box.height > 200);
    return shown.length === 1 && shown[0].left >= 0 && shown[0].right <= innerWidth;
  });
  const wide = document.documentElement.scrollWidth > innerWidth;
  parent.postMessage(`charts ${charts.length} seen ${seen.length} too wide ${wide}`, '*');
});</script></body>";

#[test]
#[ignore = "needs Chromium (CHROMIUM names it); run with --ignored"]
fn a_browser_shows_every_chart_at_any_width_and_has_nothing_to_complain_of() {
    let folder = folder();
    folder.write("measured.html", page(&folder).replace("</body>", MEASURE));
    for (width, height) in [(1280, 900), (390, 800)] {
        folder.write(
            "frame.html",
            format!(
                "<!DOCTYPE html><title>none</title><script>onmessage = e => document.title = e.data</script>\
                 <iframe src=\"measured.html\" width=\"{width}\" height=\"{height}\"></iframe>"
            ),
        );
        let browser = std::env::var_os("CHROMIUM").unwrap_or_else(|| "chromium".into());
        let output = Command::new(browser)
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--dump-dom"])
            .args(["--virtual-time-budget=5000", "--window-size=1400,1000"])
            .arg(format!("--user-data-dir={}", folder.path("profile").display()))
            .arg(format!("file://{}", folder.path("frame.html").display()))
            .output()
            .expect("Chromium starts");
        let dom = String::from_utf8_lossy(&output.stdout);
        assert!(dom.contains("<title>charts 2 seen 2 too wide false</title>"), "{width}: {dom}");
        let complaints = String::from_utf8_lossy(&output.stderr);
        assert!(!complaints.contains("CONSOLE"), "{width}: {complaints}");
    }
}
