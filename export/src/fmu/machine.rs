//! The processor and the form of a library, read from its header: what a compiler built, whatever its name promised.

use std::env;
use std::fmt;

/// What the header of a library, an object file or an archive of them states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Machine {
    form: Form,
    /// Bits of an address.
    bits: u8,
    /// The processor as `std::env::consts::ARCH` names it, or the number in the header.
    processor: Processor,
    /// Whether a program can load it: a shared object, no object file and no program.
    is_shared: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// ELF: Linux and most systems but Windows and macOS.
    Elf,
    /// PE and COFF: Windows.
    Pe,
    /// Mach-O: macOS.
    MachO,
}

impl Form {
    fn names(self) -> &'static [(u32, &'static str)] {
        match self {
            Self::Elf => &OF_ELF,
            Self::Pe => &OF_PE,
            Self::MachO => &OF_MACH_O,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Processor {
    Known(&'static str),
    Number(u32),
}

/// ELF, `e_machine` (System V ABI and its supplements).
const OF_ELF: [(u32, &str); 7] = [
    (3, "x86"),
    (21, "powerpc64"),
    (22, "s390x"),
    (40, "arm"),
    (62, "x86_64"),
    (183, "aarch64"),
    (243, "riscv64"),
];
/// PE, `Machine` (Microsoft, PE Format).
const OF_PE: [(u32, &str); 4] = [
    (0x14c, "x86"),
    (0x1c4, "arm"),
    (0x8664, "x86_64"),
    (0xaa64, "aarch64"),
];
/// Mach-O, `cputype` (Apple, mach/machine.h).
const OF_MACH_O: [(u32, &str); 4] = [
    (7, "x86"),
    (12, "arm"),
    (0x0100_0007, "x86_64"),
    (0x0100_000c, "aarch64"),
];

/// Length of a member's header in an archive, and where the size of the member is in it (System V, ar.h).
const MEMBER_HEADER: usize = 60;
const MEMBER_SIZE: std::ops::Range<usize> = 48..58;

impl Machine {
    /// Of this process, a shared library that it could load.
    pub fn here() -> Self {
        let form = match env::consts::OS {
            "windows" => Form::Pe,
            "macos" | "ios" => Form::MachO,
            _ => Form::Elf,
        };
        Self {
            form,
            bits: usize::BITS as u8,
            processor: Processor::Known(env::consts::ARCH),
            is_shared: true,
        }
    }

    /// What the bytes of a file state; `None` where they have no header of a library.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let one = || elf(bytes).or_else(|| pe(bytes)).or_else(|| mach_o(bytes));
        one().or_else(|| universal(bytes))
    }

    /// Of the first object file in the bytes of an archive (`.a`).
    pub fn of_archive(bytes: &[u8]) -> Option<Self> {
        let mut rest = bytes.strip_prefix(b"!<arch>\n")?;
        loop {
            let (header, behind) = rest.split_at_checked(MEMBER_HEADER)?;
            let size = std::str::from_utf8(&header[MEMBER_SIZE]).ok()?;
            let size: usize = size.trim().parse().ok()?;
            let (member, behind) = behind.split_at_checked(size)?;
            // BSD and macOS write a long name before the content, and its length as the name.
            let name = std::str::from_utf8(&header[..16]).ok()?;
            let long = name.strip_prefix("#1/").map(|length| length.trim().parse());
            let skipped = long.and_then(Result::ok).unwrap_or(0);
            if let Some(machine) = member.get(skipped..).and_then(Self::of) {
                return Some(machine);
            }
            // Members begin at even places.
            rest = behind.get(size % 2..)?;
        }
    }

    /// Whether a linker can put this object file into a library for `platform`. A processor that the tables above
    /// lack is not compared.
    pub fn links_into(&self, platform: &Self) -> bool {
        let has_name = |processor| match processor {
            Processor::Known(name) => platform.form.names().iter().any(|known| known.1 == name),
            Processor::Number(_) => false,
        };
        (self.form, self.bits) == (platform.form, platform.bits)
            && (self.processor == platform.processor || !has_name(platform.processor))
    }

    /// Whether a program of `platform` can load this library.
    pub fn loads_on(&self, platform: &Self) -> bool {
        self.is_shared && self.links_into(platform)
    }
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            form,
            bits,
            processor,
            is_shared,
        } = self;
        let form = match form {
            Form::Elf => "ELF",
            Form::Pe => "PE",
            Form::MachO => "Mach-O",
        };
        let kind = if *is_shared {
            "a shared library"
        } else {
            "no shared library"
        };
        match processor {
            Processor::Known(name) => write!(f, "{form}, {bits} bit, {name}, {kind}"),
            Processor::Number(number) => {
                write!(f, "{form}, {bits} bit, processor {number}, {kind}")
            }
        }
    }
}

fn named(names: &[(u32, &'static str)], number: u32) -> Processor {
    let found = names.iter().find(|(known, _)| *known == number);
    found.map_or(Processor::Number(number), |(_, name)| {
        Processor::Known(name)
    })
}

fn half_word(bytes: &[u8], at: usize, is_little: bool) -> Option<u32> {
    let bytes: [u8; 2] = bytes.get(at..at + 2)?.try_into().ok()?;
    Some(u32::from(if is_little {
        u16::from_le_bytes(bytes)
    } else {
        u16::from_be_bytes(bytes)
    }))
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let bytes: [u8; 4] = bytes.get(at..at + 4)?.try_into().ok()?;
    Some(u32::from_le_bytes(bytes))
}

/// Identification, then `e_type` at 16 (3: shared object) and `e_machine` at 18.
fn elf(bytes: &[u8]) -> Option<Machine> {
    let (class, order) = match bytes.get(..6)? {
        [0x7f, b'E', b'L', b'F', class, order] => (*class, *order),
        _ => return None,
    };
    let is_little = order == 1;
    let processor = named(&OF_ELF, half_word(bytes, 18, is_little)?);
    // The one number for both orders of bytes and both widths of these.
    let processor = match (processor, class, is_little) {
        (Processor::Known("riscv64"), 1, _) => Processor::Known("riscv32"),
        (Processor::Known("aarch64" | "arm" | "x86_64" | "x86" | "riscv64"), _, false) => {
            Processor::Number(half_word(bytes, 18, is_little)?)
        }
        (other, _, _) => other,
    };
    Some(Machine {
        form: Form::Elf,
        bits: if class == 2 { 64 } else { 32 },
        processor,
        is_shared: half_word(bytes, 16, is_little)? == 3,
    })
}

/// The offset of the header `PE\0\0` at 0x3c; behind it `Machine`, and `Characteristics` (0x2000: a DLL).
fn pe(bytes: &[u8]) -> Option<Machine> {
    if bytes.get(..2)? != b"MZ" {
        return None;
    }
    let at = word(bytes, 0x3c)? as usize;
    if bytes.get(at..at.checked_add(4)?)? != b"PE\0\0" {
        return None;
    }
    let processor = named(&OF_PE, half_word(bytes, at + 4, true)?);
    Some(Machine {
        form: Form::Pe,
        // The optional header: 0x20b with addresses of 64 bits.
        bits: if half_word(bytes, at + 24, true)? == 0x20b {
            64
        } else {
            32
        },
        processor,
        is_shared: half_word(bytes, at + 22, true)? & 0x2000 != 0,
    })
}

/// The magic number, `cputype`, `cpusubtype`, `filetype` (6: a shared library, 8: a bundle).
fn mach_o(bytes: &[u8]) -> Option<Machine> {
    let bits = match word(bytes, 0)? {
        0xfeed_face => 32,
        0xfeed_facf => 64,
        _ => return None,
    };
    Some(Machine {
        form: Form::MachO,
        bits,
        processor: named(&OF_MACH_O, word(bytes, 4)?),
        is_shared: matches!(word(bytes, 12)?, 6 | 8),
    })
}

/// A Mach-O file of several processors: that of this one, else the first. Big-endian: the magic number, how many
/// there are, and for each five words, of which the third is the offset.
fn universal(bytes: &[u8]) -> Option<Machine> {
    let big = |at| word(bytes, at).map(u32::swap_bytes);
    if big(0)? != 0xcafe_babe {
        return None;
    }
    let slices = (0..big(4)?.min(64) as usize).filter_map(|slice| {
        let offset = big(8 + 20 * slice + 8)? as usize;
        mach_o(bytes.get(offset..)?)
    });
    let all: Vec<Machine> = slices.collect();
    let here = all.iter().find(|slice| slice.loads_on(&Machine::here()));
    here.or(all.first()).copied()
}

#[cfg(test)]
mod tests {
    use super::Machine;

    /// This program: what the system loads is what the constants of the compiler name.
    #[test]
    fn this_program_is_of_this_machine() {
        let program = std::fs::read(std::env::current_exe().expect("a program")).expect("it");
        let machine = Machine::of(&program).expect("a header");
        assert!(machine.links_into(&Machine::here()), "{machine}");
    }

    #[test]
    fn each_form_is_read_and_what_is_cut_off_is_none() {
        let mut elf = b"\x7fELF\x02\x01\x01".to_vec();
        elf.resize(16, 0);
        elf.extend([3, 0, 183, 0]);
        let mut pe = b"MZ".to_vec();
        pe.resize(0x3c, 0);
        pe.extend(0x40_u32.to_le_bytes());
        pe.extend(b"PE\0\0\x64\x86");
        pe.resize(0x40 + 22, 0);
        pe.extend([0, 0x20, 0x0b, 2]);
        let mach_o: Vec<u8> = [0xfeed_facf_u32, 0x0100_000c, 0, 6]
            .iter()
            .flat_map(|word| word.to_le_bytes())
            .collect();
        for (bytes, expected) in [
            (&elf, "ELF, 64 bit, aarch64, a shared library"),
            (&pe, "PE, 64 bit, x86_64, a shared library"),
            (&mach_o, "Mach-O, 64 bit, aarch64, a shared library"),
        ] {
            let found = Machine::of(bytes).map(|machine| machine.to_string());
            assert_eq!(found.as_deref(), Some(expected));
            for end in 0..bytes.len() {
                assert_eq!(Machine::of(&bytes[..end]), None, "{expected} at {end}");
            }
        }
        let mut universal: Vec<u8> = [0xcafe_babe_u32, 1, 0, 0, 28, 16, 0]
            .iter()
            .flat_map(|word| word.to_be_bytes())
            .collect();
        universal.extend(&mach_o);
        assert_eq!(Machine::of(&universal), Machine::of(&mach_o));
        // An archive: its table of symbols first, then an object at an even place.
        let member = |name: &str, content: &[u8]| {
            let mut member = format!("{name:<48}{:<10}`\n", content.len()).into_bytes();
            member.extend(content);
            member.resize(member.len().next_multiple_of(2), b'\n');
            member
        };
        let mut archive = b"!<arch>\n".to_vec();
        archive.extend(member("/", b"odd"));
        archive.extend(member("one.o/", &elf));
        assert_eq!(Machine::of_archive(&archive), Machine::of(&elf));
        let mut archive = b"!<arch>\n".to_vec();
        archive.extend(member("#1/20", &[&[b'n'; 20], &mach_o[..]].concat()));
        assert_eq!(Machine::of_archive(&archive), Machine::of(&mach_o));
        assert_eq!(Machine::of_archive(b"!<arch>\n"), None);
        assert_eq!(Machine::of_archive(&elf), None);
    }
}
