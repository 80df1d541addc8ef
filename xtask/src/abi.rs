//! What old programs rely on: the size of every struct, where its fields are, every value and every function,
//! as the compiler sees them, against `include/muslin.abi`.

use std::path::PathBuf;

use crate::failure::{Failure, Result};
use crate::{c, files, shell};

const COMMAND: &str = "MUSLIN_BLESS=1 cargo xtask c";

fn path() -> PathBuf {
    files::root().join("include/muslin.abi")
}

/// Fails where the header says other than the file; with `MUSLIN_BLESS` set, writes the file.
pub fn check() -> Result {
    let header = without_comments(&files::read(&files::root().join("include/muslin.h"))?);
    let source = c::built().join("abi.c");
    files::write(&source, &program(&header))?;
    let program = c::built().join("abi");
    let mut cc = shell::command("cc");
    cc.args(["-std=c99", "-Wall", "-Werror", "-I"]).arg(files::root().join("include"));
    shell::run(cc.arg("-o").arg(&program).arg(&source))?;
    let laid_out = shell::output(&mut shell::command(&program))?;
    let seen = format!(
        "# What programs that are already built rely on, on 64-bit machines: lines may be added, not changed.\n\
         # Written by {COMMAND}\n\n{laid_out}\n{}\n",
        functions(&header).join("\n")
    );
    if std::env::var_os("MUSLIN_BLESS").is_some() {
        files::write(&path(), &seen)?;
    }
    compare(&files::read(&path())?, &seen)
}

fn compare(kept: &str, seen: &str) -> Result {
    let lost = kept.lines().find(|line| !seen.lines().any(|other| other == *line));
    if let Some(line) = lost {
        return Err(Failure::new(format!(
            "old programs rely on this, and it is so no more: {}; if that must be, see CHANGELOG.md and \
             run: {COMMAND}",
            line.trim()
        )));
    }
    if kept != seen {
        return Err(Failure::new(format!("include/muslin.abi lacks what is new; run: {COMMAND}")));
    }
    Ok(())
}

pub fn without_comments(text: &str) -> String {
    let mut kept = String::new();
    let mut rest = text;
    while let Some((before, comment)) = rest.split_once("/*") {
        kept += before;
        rest = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    kept += rest;
    kept.lines().map(|line| line.split("//").next().unwrap_or_default().to_owned() + "\n").collect()
}

/// A program that prints how structs are laid out and what constants are worth.
fn program(header: &str) -> String {
    let grows = |name: &str| {
        let body = header.split_once(&format!("typedef struct {name} {{"));
        body.is_some_and(|(_, body)| body.trim_start().starts_with("uint32_t struct_size;"))
    };
    let mut lines = Vec::new();
    let mut inside = None;
    for line in header.lines().map(str::trim) {
        if let Some(name) = line.strip_prefix("typedef struct ").and_then(|l| l.strip_suffix(" {"))
        {
            lines.push(if grows(name) {
                format!("puts(\"struct {name}: grows at its end\");")
            } else {
                format!("print(\"struct {name}\", 0, sizeof({name}));")
            });
            inside = Some(name);
        } else if line.starts_with('}') {
            inside = None;
        } else if let (Some(of), Some(field)) = (inside, line.strip_suffix(';')) {
            let name = field.rsplit([' ', '*']).next().unwrap_or(field);
            let name = name.split('[').next().unwrap_or(name);
            let size = format!("sizeof((({of} *)0)->{name})");
            // What grows pushes on what follows it, which the library allows for.
            lines.push(if grows(field.split(' ').next().unwrap_or(field)) {
                format!("puts(\"  {of}.{name}: grows\");")
            } else {
                format!("print(\"  {of}.{name}\", offsetof({of}, {name}), {size});")
            });
        } else if let Some(value) = line.strip_prefix("#define MUSLIN_") {
            let name = value.split(' ').next().unwrap_or(value);
            lines.push(format!("tell(\"MUSLIN_{name}\", MUSLIN_{name});"));
        } else if line.starts_with("MUSLIN_") && line.ends_with(',') {
            let name = line.split(' ').next().unwrap_or(line);
            lines.push(format!("tell(\"{name}\", {name});"));
        }
    }
    format!(
        "#include <muslin.h>\n#include <stdio.h>\n\
         static void print(const char *what, size_t at, size_t size) {{\n\
         printf(\"%s: at %lu, %lu bytes\\n\", what, (unsigned long)at, (unsigned long)size);\n}}\n\
         static void tell(const char *what, unsigned long value) {{\n\
         printf(\"%s = %lu\\n\", what, value);\n}}\n\
         int main(void) {{\n{}\nreturn 0;\n}}\n",
        lines.join("\n")
    )
}

/// The functions as they are declared, each on a line.
pub fn functions(header: &str) -> Vec<String> {
    let flat: Vec<&str> = header.lines().filter(|line| !line.starts_with('#')).collect();
    let mut found: Vec<String> = flat
        .join(" ")
        .split([';', '{', '}'])
        .map(|part| part.split_whitespace().collect::<Vec<_>>().join(" "))
        .filter(|part| {
            part.ends_with(')') && part.contains(" muslin_") || part.contains(" *muslin_")
        })
        .filter(|part| !part.starts_with("static") && !part.contains('=') && !part.starts_with("("))
        .filter(|part| part.split('(').next().is_some_and(|head| head.split(' ').count() <= 3))
        .collect();
    found.sort();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "/** A b; */ #define MUSLIN_A 3\ntypedef struct MuslinB {\n  /** c; */\n  \
                          const float *at;\n  float list[4];\n} MuslinB;\n#define MUSLIN_A 3\n\
                          typedef struct MuslinG {\n  uint32_t struct_size;\n} \
                          MuslinG;\nenum MuslinS {\n  MUSLIN_S_OK = 0,\n};\nMuslinStatus muslin_do(MuslinB b,\n    \
                          uint32_t *out);\nconst char *muslin_say(void);\nstatic inline void \
                          muslin_b_init(MuslinB *b) {\n  (void)muslin_b(b);\n}\n";

    #[test]
    fn structs_values_and_functions_are_found() {
        let header = without_comments(HEADER);
        let program = program(&header);
        for line in [
            "print(\"struct MuslinB\", 0, sizeof(MuslinB));",
            "print(\"  MuslinB.at\", offsetof(MuslinB, at), sizeof(((MuslinB *)0)->at));",
            "print(\"  MuslinB.list\", offsetof(MuslinB, list), sizeof(((MuslinB *)0)->list));",
            "puts(\"struct MuslinG: grows at its end\");",
            "tell(\"MUSLIN_A\", MUSLIN_A);",
            "tell(\"MUSLIN_S_OK\", MUSLIN_S_OK);",
        ] {
            assert!(program.contains(line), "{program}");
        }
        let declared =
            ["MuslinStatus muslin_do(MuslinB b, uint32_t *out)", "const char *muslin_say(void)"];
        assert_eq!(functions(&header), declared);
    }

    #[test]
    fn what_changes_is_refused_and_what_is_new_wants_to_be_kept() {
        assert!(compare("a\nb\n", "a\nb\n").is_ok());
        let changed = compare("a\n  b: at 4\n", "a\n  b: at 8\n").unwrap_err().to_string();
        assert!(changed.contains("so no more: b: at 4"), "{changed}");
        assert!(compare("a\n", "a\nb\n").unwrap_err().to_string().contains("lacks what is new"));
    }
}
