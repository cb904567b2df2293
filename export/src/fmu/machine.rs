//! Reads the processor and the file format of a library from its header, to check what a compiler really built.

use std::env;
use std::fmt;

/// Type of a library or object file, as stated in its header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Machine {
    format: Format,
    /// Address size in bits.
    bits: u8,
    /// Processor.
    processor: Processor,
    /// True for a shared library, which a program can load; false for object files and programs.
    is_shared: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    /// ELF: Linux and most systems other than Windows and macOS.
    Elf,
    /// PE and COFF: Windows.
    Pe,
    /// Mach-O: macOS.
    MachO,
}

impl Format {
    /// Numbers and names of the processors known for this format.
    fn names(self) -> &'static [(u32, &'static str)] {
        match self {
            Self::Elf => &ELF_PROCESSORS,
            Self::Pe => &PE_PROCESSORS,
            Self::MachO => &MACH_O_PROCESSORS,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Processor {
    /// Name as in `std::env::consts::ARCH`.
    Known(&'static str),
    /// Unknown number in the header.
    Number(u32),
}

/// ELF `e_machine` (System V ABI and its supplements).
const ELF_PROCESSORS: [(u32, &str); 7] = [
    (3, "x86"),
    (21, "powerpc64"),
    (22, "s390x"),
    (40, "arm"),
    (62, "x86_64"),
    (183, "aarch64"),
    (243, "riscv64"),
];
/// PE `Machine` (Microsoft, PE Format).
const PE_PROCESSORS: [(u32, &str); 4] = [
    (0x14c, "x86"),
    (0x1c4, "arm"),
    (0x8664, "x86_64"),
    (0xaa64, "aarch64"),
];
/// Mach-O `cputype` (Apple, mach/machine.h).
const MACH_O_PROCESSORS: [(u32, &str); 4] = [
    (7, "x86"),
    (12, "arm"),
    (0x0100_0007, "x86_64"),
    (0x0100_000c, "aarch64"),
];

/// Length of a member's header in an archive, and the position of the member's size in it (System V, ar.h).
const MEMBER_HEADER: usize = 60;
const MEMBER_SIZE: std::ops::Range<usize> = 48..58;

impl Machine {
    /// Returns the type of shared library that this process can load.
    pub fn here() -> Self {
        Self {
            bits: usize::BITS as u8,
            ..Self::shared(env::consts::ARCH, env::consts::OS)
        }
    }

    /// Returns the type of shared library of a system, for a processor with its name in `std::env::consts::ARCH`.
    pub(super) fn shared(processor: &'static str, system: &str) -> Self {
        Self {
            format: match system {
                "windows" => Format::Pe,
                "macos" | "ios" | "darwin" => Format::MachO,
                _ => Format::Elf,
            },
            bits: if processor.contains("64") { 64 } else { 32 },
            processor: Processor::Known(processor),
            is_shared: true,
        }
    }

    /// Reads the type from the bytes of a file; `None` if the header is unknown or incomplete.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let single = || elf(bytes).or_else(|| pe(bytes)).or_else(|| mach_o(bytes));
        single().or_else(|| universal(bytes))
    }

    /// Reads the type of the first object file in the bytes of an archive (`.a`).
    pub fn of_archive(bytes: &[u8]) -> Option<Self> {
        let mut rest = bytes.strip_prefix(b"!<arch>\n")?;
        loop {
            let (header, behind) = rest.split_at_checked(MEMBER_HEADER)?;
            let size = std::str::from_utf8(&header[MEMBER_SIZE]).ok()?;
            let size: usize = size.trim().parse().ok()?;
            let (member, behind) = behind.split_at_checked(size)?;
            // If a name is long, BSD and macOS write it before the content, and write its length into the name field.
            let name = std::str::from_utf8(&header[..16]).ok()?;
            let long = name.strip_prefix("#1/").map(|length| length.trim().parse());
            let skipped = long.and_then(Result::ok).unwrap_or(0);
            if let Some(machine) = member.get(skipped..).and_then(Self::of) {
                return Some(machine);
            }
            // Members start at even offsets.
            rest = behind.get(size % 2..)?;
        }
    }

    /// True if a linker can put this object file into a library for `platform`. A processor that is missing from the
    /// tables above is not compared.
    pub fn links_into(&self, platform: &Self) -> bool {
        let has_name = |processor| match processor {
            Processor::Known(name) => platform.format.names().iter().any(|known| known.1 == name),
            Processor::Number(_) => false,
        };
        (self.format, self.bits) == (platform.format, platform.bits)
            && (self.processor == platform.processor || !has_name(platform.processor))
    }

    /// True if a program of `platform` can load this library.
    pub fn loads_on(&self, platform: &Self) -> bool {
        self.is_shared && self.links_into(platform)
    }
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            format,
            bits,
            processor,
            is_shared,
        } = self;
        let format = match format {
            Format::Elf => "ELF",
            Format::Pe => "PE",
            Format::MachO => "Mach-O",
        };
        let kind = if *is_shared {
            "a shared library"
        } else {
            "not a shared library"
        };
        match processor {
            Processor::Known(name) => write!(f, "{format}, {bits} bit, {name}, {kind}"),
            Processor::Number(number) => {
                write!(f, "{format}, {bits} bit, processor {number}, {kind}")
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

/// Reads an ELF header: identification, `e_type` at offset 16 (3: shared object), `e_machine` at offset 18.
fn elf(bytes: &[u8]) -> Option<Machine> {
    let (class, order) = match bytes.get(..6)? {
        [0x7f, b'E', b'L', b'F', class, order] => (*class, *order),
        _ => return None,
    };
    let is_little = order == 1;
    let processor = named(&ELF_PROCESSORS, half_word(bytes, 18, is_little)?);
    // These processors share one number for both byte orders and both widths.
    let processor = match (processor, class, is_little) {
        (Processor::Known("riscv64"), 1, _) => Processor::Known("riscv32"),
        (Processor::Known("aarch64" | "arm" | "x86_64" | "x86" | "riscv64"), _, false) => {
            Processor::Number(half_word(bytes, 18, is_little)?)
        }
        (other, _, _) => other,
    };
    Some(Machine {
        format: Format::Elf,
        bits: if class == 2 { 64 } else { 32 },
        processor,
        is_shared: half_word(bytes, 16, is_little)? == 3,
    })
}

/// Reads a PE header: the offset of `PE\0\0` is at 0x3c; after it come `Machine` and `Characteristics` (0x2000: a DLL).
fn pe(bytes: &[u8]) -> Option<Machine> {
    if bytes.get(..2)? != b"MZ" {
        return None;
    }
    let at = word(bytes, 0x3c)? as usize;
    if bytes.get(at..at.checked_add(4)?)? != b"PE\0\0" {
        return None;
    }
    let processor = named(&PE_PROCESSORS, half_word(bytes, at + 4, true)?);
    Some(Machine {
        format: Format::Pe,
        // Optional header: 0x20b for 64-bit addresses.
        bits: if half_word(bytes, at + 24, true)? == 0x20b {
            64
        } else {
            32
        },
        processor,
        is_shared: half_word(bytes, at + 22, true)? & 0x2000 != 0,
    })
}

/// Reads a Mach-O header: magic number, `cputype`, `cpusubtype`, `filetype` (6: a shared library, 8: a bundle).
fn mach_o(bytes: &[u8]) -> Option<Machine> {
    let bits = match word(bytes, 0)? {
        0xfeed_face => 32,
        0xfeed_facf => 64,
        _ => return None,
    };
    Some(Machine {
        format: Format::MachO,
        bits,
        processor: named(&MACH_O_PROCESSORS, word(bytes, 4)?),
        is_shared: matches!(word(bytes, 12)?, 6 | 8),
    })
}

/// Reads a universal Mach-O file and returns the slice for this machine, or else the first one. The header is
/// big-endian: magic number, number of slices, and five words per slice. The third word is the offset of the slice.
fn universal(bytes: &[u8]) -> Option<Machine> {
    let big_endian = |at| word(bytes, at).map(u32::swap_bytes);
    if big_endian(0)? != 0xcafe_babe {
        return None;
    }
    let slices = (0..big_endian(4)?.min(64) as usize).filter_map(|slice| {
        let offset = big_endian(8 + 20 * slice + 8)? as usize;
        mach_o(bytes.get(offset..)?)
    });
    let all: Vec<Machine> = slices.collect();
    let here = all.iter().find(|slice| slice.loads_on(&Machine::here()));
    here.or(all.first()).copied()
}

#[cfg(test)]
mod tests {
    use super::Machine;

    /// The system loaded this program, so its header must agree with the compiler's constants.
    #[test]
    fn the_test_program_is_recognised_as_this_machine() {
        let program = std::fs::read(std::env::current_exe().expect("a program")).expect("it");
        let machine = Machine::of(&program).expect("a header");
        assert!(machine.links_into(&Machine::here()), "{machine}");
    }

    #[test]
    fn each_format_is_read_and_truncated_files_are_unknown() {
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
        // An archive: first the symbol table, then an object file at an even offset.
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
