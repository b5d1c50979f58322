//! Which columns of a file are address, size and kind: by its first line, by what was asked for, or by both.

use crate::BadQuestion;
use crate::traces::text::quoted;

/// Where the columns are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Places {
    pub(super) address: usize,
    pub(super) size: Option<usize>,
    pub(super) kind: Option<usize>,
    /// Are the addresses keys, texts of any kind?
    pub(super) keys: bool,
}

impl Places {
    /// Where nothing names them.
    const PLAIN: Self = Self { address: 0, size: Some(1), kind: Some(2), keys: false };

    /// Where columns of these names stand among `names`.
    fn of(address: &str, size: &str, kind: &str, names: &[String]) -> Option<Self> {
        let find = |name: &str| names.iter().position(|known| known == name);
        Some(Self { address: find(address)?, size: find(size), kind: find(kind), keys: false })
    }
}

const ADDRESS: &str = "address";
const ROLES: [&str; 3] = [ADDRESS, "size", "kind"];
/// What the column of addresses is called where they are keys.
const KEY: &str = "key";
/// What the column of addresses is called by others, where one of these names is there alone.
const ADDRESSES: [&str; 8] = ["addr", "vaddr", "object", "obj", "object_id", "obj_id", "lbn", "lba"];

/// Where the columns are, as far as that is known.
#[derive(Clone, Debug)]
pub(super) enum Columns {
    /// As the first line tells.
    Unknown,
    /// Here, unless the first line has no numbers: then below it.
    Asked(Places),
    /// Where the first line has these names: those of address, size and kind; or, without such a line, there.
    Named { names: [String; 3], places: Option<Places>, keys: bool },
    /// Here.
    Found(Places),
}

impl Columns {
    pub(super) fn unknown() -> Self {
        Self::Unknown
    }

    /// As asked for: roles in the order of the columns, names of columns, or roles and names such as `address=lbn`. The role
    /// `key` is that of an address of any text.
    pub(super) fn asked(asked: &[String]) -> Result<Self, BadQuestion> {
        let wrong = |what: String| BadQuestion::new(format!("--columns: {what}"));
        let split = |item: &String| match item.split_once('=') {
            Some((role, name)) => (Some(role.to_owned()), name.to_lowercase()),
            None => (None, item.to_lowercase()),
        };
        let items: Vec<(Option<String>, String)> = asked.iter().map(split).collect();
        let mut names = ROLES.map(str::to_owned);
        let (mut given, mut keys) = ([false; 3], false);
        let mut others = vec![];
        for (role, name) in &items {
            let said = role.as_ref().unwrap_or(name);
            keys |= said == KEY;
            let said = if said == KEY { ADDRESS } else { said };
            match ROLES.iter().position(|known| *known == said) {
                Some(at) if given[at] => return Err(wrong(format!("{} is there twice", ROLES[at]))),
                Some(at) => (names[at], given[at]) = (name.clone(), true),
                None if role.is_some() => {
                    return Err(wrong("columns are address or key, size and kind, such as address=lbn".into()));
                }
                None if name != "_" => others.push(name),
                None => {}
            }
        }
        if given[0] && !others.is_empty() {
            return Err(wrong(format!("`{}` is none of address, size, kind, and _ for one to skip", others[0])));
        }
        if !given[0] {
            let known: Vec<_> = others.iter().filter(|name| ADDRESSES.contains(&name.as_str())).collect();
            names[0] = match (&others[..], &known[..]) {
                ([], _) => return Err(wrong("one of them must be address, address=NAME, or key for texts".into())),
                ([one], _) => (*one).clone(),
                (_, [one]) => (**one).clone(),
                _ => return Err(wrong("which of them is the address? Write address=NAME".into())),
            };
        }
        let in_order: Vec<String> = items.iter().map(|(_, name)| name.clone()).collect();
        let [address, size, kind] = &names;
        let places = if items.iter().all(|(role, _)| role.is_none()) {
            Places::of(address, size, kind, &in_order)
        } else {
            None
        };
        Ok(match places.map(|places| Places { keys, ..places }) {
            Some(places) if others.is_empty() => Self::Asked(places),
            places => Self::Named { names, places, keys },
        })
    }

    /// Where they are, if that is settled.
    pub(super) fn found(&self) -> Option<Places> {
        match self {
            Self::Found(places) => Some(*places),
            _ => None,
        }
    }

    /// They are here.
    pub(super) fn settle(&mut self, places: Places) {
        *self = Self::Found(places);
    }

    /// Where they are, as the fields of the first line tell; nothing if that line says no more than their names, or nothing.
    pub(super) fn find(&mut self, fields: &[Vec<u8>], comment: bool) -> Result<Option<Places>, String> {
        let lower = |field: &Vec<u8>| String::from_utf8_lossy(field).to_lowercase();
        let names: Vec<String> = fields.iter().map(lower).collect();
        let named = match self {
            Self::Unknown => Places::of(ADDRESS, ROLES[1], ROLES[2], &names).or_else(|| {
                let mut known = names.iter().filter(|name| ADDRESSES.contains(&name.as_str()));
                let one = known.next().filter(|_| known.next().is_none())?;
                Places::of(one, ROLES[1], ROLES[2], &names)
            }),
            Self::Named { names: [address, size, kind], keys, .. } => {
                Places::of(address, size, kind, &names).map(|places| Places { keys: *keys, ..places })
            }
            // A key may look like a name.
            Self::Asked(places) if places.keys => {
                let known = |name: &String| name == KEY || name == ADDRESS || ADDRESSES.contains(&name.as_str());
                (!comment && names.get(places.address).is_some_and(known)).then_some(*places)
            }
            Self::Asked(places) => (!comment && !has_numbers(fields)).then_some(*places),
            Self::Found(places) => Some(*places),
        };
        if let Some(places) = named {
            self.settle(places);
            return Ok(None);
        }
        match self {
            _ if comment => Ok(None),
            Self::Unknown if fields.len() > 3 => {
                Err("more than address, size and kind; name the columns with --columns".into())
            }
            Self::Unknown => Ok(Some(Places::PLAIN)),
            Self::Named { places: Some(places), .. } if has_numbers(fields) => Ok(Some(*places)),
            Self::Named { names: [address, ..], .. } => {
                Err(format!("{} has no column `{address}`", quoted(&fields.join(&b","[..]))))
            }
            Self::Asked(places) | Self::Found(places) => Ok(Some(*places)),
        }
    }
}

/// Does one of the fields begin with a digit? Names do not.
fn has_numbers(fields: &[Vec<u8>]) -> bool {
    fields.iter().any(|field| field.first().is_some_and(u8::is_ascii_digit))
}
