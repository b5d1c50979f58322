//! Do caches read as they are printed, and do refusals say what would do?

use super::*;

#[test]
fn what_is_printed_reads_back() {
    for (text, printed) in [
        ("128K,full,128,lru", "128K,full,128,lru"),
        ("131072,full,128,lru", "128K,full,128,lru"),
        ("64KiB,8,64B,lru", "64K,8,64,lru"),
        ("384,3,128,lru", "384,3,128,lru"),
        ("4K,1,4K,lru", "4K,1,4K,lru"),
        ("128K,8,128,lru,hash", "128K,8,128,lru,hash"),
        ("128K,full,128,fifo", "128K,full,128,fifo"),
        ("384,3,128,clock", "384,3,128,clock"),
        ("96K,8,128,lru", "96K,8,128,lru"),
        ("384,3,128,random", "384,3,128,random"),
        ("384,3,128,random:0", "384,3,128,random"),
        ("384,3,128,random:18446744073709551615,hash", "384,3,128,random:18446744073709551615,hash"),
        ("128K,full,128,plru", "128K,full,128,plru"),
        ("128K,full,128,min", "128K,full,128,min"),
        ("128K,4,128,min-bypass", "128K,4,128,min-bypass"),
        ("none", "none,128"),
        ("none,64", "none,64"),
    ] {
        let config: CacheConfig = text.parse().unwrap();
        assert_eq!(config.to_string(), printed);
        assert_eq!(printed.parse(), Ok(config));
    }
}

#[test]
fn refusals_say_what_would_do() {
    for (text, hint) in [
        ("", "SIZE,WAYS,LINE,POLICY"),
        ("128K", "SIZE,WAYS,LINE,POLICY"),
        ("128K,full,128", "SIZE,WAYS,LINE,POLICY"),
        ("128K,full,128,lru,", "SIZE,WAYS,LINE,POLICY"),
        ("128KB,full,128,lru", "write 128K"),
        ("128K,8way,128,lru", "`full` or a number"),
        ("128K,0,128,lru", "`full` or a number"),
        ("128K,,128,lru", "`full` or a number"),
        ("128K,+8,128,lru", "`full` or a number"),
        (
            "128K,full,128,LUR",
            "there are lru, fifo, clock, clock-clear, random, random:SEED, plru, srrip, lfu, min, min-bypass, and none",
        ),
        ("128K,full,128,none", "none for no cache"),
        ("128K,full,128,random:", "random:SEED"),
        ("128K,full,128,random:+1", "random:SEED"),
        ("128K,full,128,random:18446744073709551616", "random:SEED"),
        ("128K,8,128,lru,skew", "may end in ,hash"),
        ("128K,full,128,lru,hash", "leave out `,hash`"),
        ("384,3,128,plru", "not 3; 2 would do"),
        ("7K,7,128,plru", "not 7; 8 would do"),
        ("96K,full,128,plru", "not 768; 512 would do"),
        ("128K,full,100,lru", "128 would do"),
        ("128K,full,0,lru", "4 would do"),
        ("128K,full,2,lru", "4 would do"),
        ("128K,full,4G,lru", "2147483648 would do"),
        ("0,full,128,lru", "128 would do"),
        ("1000,full,128,lru", "1K would do"),
        ("96K,8,128,lru,hash", "64K in 8 ways would do"),
        ("112K,8,128,lru,hash", "128K in 8 ways would do"),
        ("128K,7,128,lru", "112K in 7 ways would do"),
        ("1K,16,128,lru", "2K in 16 ways would do"),
        ("16777215T,11,128,lru", "would do"),
        ("18446744073709551615,full,4,lru", "18446744073709551612 would do"),
    ] {
        let message = text.parse::<CacheConfig>().unwrap_err().to_string();
        assert!(message.contains(hint), "{text}: {message}");
    }
}
