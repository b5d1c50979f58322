//! Is what gather rays do at mirrors and glass what was asked, and does waiting change nothing but the order?

use crate::support::{Folder, SMALL, same_bytes};

#[test]
fn waiting_for_the_end_of_the_batch_changes_the_order_and_nothing_else() {
    let folder = Folder::with_streams();
    for order in ["", "--order tiled --tile 8", "--order direction-binned --tile 8", "--irradiance-cache 0.3"] {
        folder.run(&format!("pm-queries {SMALL} {order} --base plain.exr -o plain.pmq")).ok();
        let line = format!("pm-queries {SMALL} {order} --queue-specular --base queued.exr -o queued.pmq");
        folder.run(&line).ok();
        same_bytes(&line, &folder.read("plain.exr"), &folder.read("queued.exr"));
        let once = folder.read("queued.pmq");
        folder.run(&format!("{line} -t 3")).ok();
        same_bytes(&format!("{line} -t 3"), &once, &folder.read("queued.pmq"));
        let records = |name: &str| {
            let csv = folder.run(&format!("pm-view --records=100000 {name}")).ok().text().to_owned();
            csv.lines().map(str::to_owned).collect::<Vec<_>>()
        };
        let (plain, queued) = (records("plain.pmq"), records("queued.pmq"));
        assert_ne!(plain, queued, "{order}: nothing waited");
        // The order does not count for the picture.
        let picture = |queries: &str| {
            folder.run(&format!("pm-gather map.pmp {queries} -k 20 --no-trace --image {queries}.png")).ok();
            folder.read(&format!("{queries}.png"))
        };
        same_bytes(order, &picture("plain.pmq"), &picture("queued.pmq"));
    }
    // A machine's part has what the whole has of it.
    let tiled = format!("pm-queries {SMALL} --order tiled --tile 8 --queue-specular");
    folder.run(&format!("{tiled} -o whole.pmq")).ok();
    folder.run(&format!("{tiled} --part 1/2 -o a.pmq")).ok();
    folder.run(&format!("{tiled} --part 2/2 -o b.pmq")).ok();
    folder.run("pm-view --merge a.pmq b.pmq -o merged.pmq").ok();
    same_bytes("parts", &folder.read("whole.pmq"), &folder.read("merged.pmq"));
}

#[test]
fn the_usual_is_what_it_was() {
    let folder = Folder::with_streams();
    let line = format!("pm-queries {SMALL} --at-specular go-on -o q2.pmq");
    folder.run(&line).ok();
    let header = |name: &str| folder.run(&format!("pm-view {name}")).ok().text().to_owned();
    assert!(!header("q.pmq").contains("at specular") && !header("q2.pmq").contains("at specular"));
    folder.run(&format!("pm-queries {SMALL} --at-specular stop -o stop.pmq")).ok();
    let stop = header("stop.pmq");
    assert!(stop.contains("at specular") && stop.contains("stop"), "{stop}");
    folder.run(&format!("pm-queries {SMALL} --at-specular gather -o gather.pmq")).ok();
    folder.run("pm-gather map.pmp gather.pmq -k 20 --no-trace --image g.png").ok();
}

#[test]
fn what_does_nothing_is_refused() {
    let folder = Folder::new();
    for options in ["--at-specular stop --direct-visualisation", "--at-specular gather --queue-specular"] {
        let outcome = folder.run(&format!("pm-queries {SMALL} {options} -o x.pmq"));
        assert!(outcome.fails(2).contains("leave out one of them"), "{outcome:?}");
    }
    for options in ["--queue-specular --direct-visualisation", "--queue-specular --only-tiles 4 --window 8"] {
        let outcome = folder.run(&format!("pm-queries {SMALL} {options} -o x.pmq"));
        assert!(outcome.code == 2 && outcome.stderr.contains("cannot be used with"), "{outcome:?}");
    }
    assert!(folder.names().is_empty());
}
