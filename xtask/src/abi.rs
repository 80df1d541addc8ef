//! Compares the binary interface of the C library with `include/muslin.abi`: the size of every
//! struct, the offsets of its fields, every constant and every function, as the C compiler reports
//! them. Programs that are already compiled rely on them.

use std::path::PathBuf;

use crate::failure::{Failure, Result};
use crate::{c, files, shell};

const COMMAND: &str = "MUSLIN_BLESS=1 cargo xtask c";

fn abi_file() -> PathBuf {
    files::root().join("include/muslin.abi")
}

/// Fails where the header differs from the file. With `MUSLIN_BLESS` set, writes the file.
pub fn check() -> Result {
    let header = without_comments(&files::read(&files::root().join("include/muslin.h"))?);
    let source = c::program_dir().join("abi.c");
    files::write(&source, &program(&header))?;
    let program = c::program_dir().join("abi");
    let mut cc = shell::command("cc");
    cc.args(["-std=c99", "-Wall", "-Werror", "-I"]).arg(files::root().join("include"));
    shell::run(cc.arg("-o").arg(&program).arg(&source))?;
    let layout = shell::output(&mut shell::command(&program))?;
    let current = format!(
        "# What programs that are already built rely on, on 64-bit machines: \
         lines may be added, not changed.\n\
         # Written by {COMMAND}\n\n{layout}\n{}\n",
        functions(&header).join("\n")
    );
    if std::env::var_os("MUSLIN_BLESS").is_some() {
        files::write(&abi_file(), &current)?;
    }
    compare(&files::read(&abi_file())?, &current)
}

fn compare(recorded: &str, current: &str) -> Result {
    let lost = recorded.lines().find(|line| !current.lines().any(|other| other == *line));
    if let Some(line) = lost {
        return Err(Failure::new(format!(
            "the header has changed what compiled programs rely on: {}; if that is intended, say \
             why in CHANGELOG.md and run: {COMMAND}",
            line.trim()
        )));
    }
    if recorded != current {
        return Err(Failure::new(format!(
            "include/muslin.abi lacks what the header adds; run: {COMMAND}"
        )));
    }
    Ok(())
}

/// The text of a C header without its comments.
pub fn without_comments(text: &str) -> String {
    let mut code = String::new();
    let mut rest = text;
    while let Some((before, comment)) = rest.split_once("/*") {
        code += before;
        rest = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    code += rest;
    code.lines().map(|line| line.split("//").next().unwrap_or_default().to_owned() + "\n").collect()
}

/// A C program that prints the layout of every struct and the value of every constant.
fn program(header: &str) -> String {
    let grows = |name: &str| {
        let body = header.split_once(&format!("typedef struct {name} {{"));
        body.is_some_and(|(_, body)| body.trim_start().starts_with("uint32_t struct_size;"))
    };
    let mut lines = Vec::new();
    let mut inside = None;
    let mut is_movable = false;
    for line in header.lines().map(str::trim) {
        if let Some(name) = line.strip_prefix("typedef struct ").and_then(|l| l.strip_suffix(" {"))
        {
            lines.push(if grows(name) {
                format!("puts(\"struct {name}: grows at its end\");")
            } else {
                format!("print(\"struct {name}\", 0, sizeof({name}));")
            });
            (inside, is_movable) = (Some(name), false);
        } else if line.starts_with('}') {
            inside = None;
        } else if let (Some(of), Some(field)) = (inside, line.strip_suffix(';')) {
            let name = field.rsplit([' ', '*']).next().unwrap_or(field);
            let name = name.split('[').next().unwrap_or(name);
            let size = format!("sizeof((({of} *)0)->{name})");
            // A field that grows moves the fields behind it, which the library allows.
            lines.push(if grows(field.split(' ').next().unwrap_or(field)) {
                is_movable = true;
                format!("puts(\"  {of}.{name}: grows\");")
            } else if is_movable {
                format!("puts(\"  {of}.{name}: behind fields that grow\");")
            } else {
                format!("print(\"  {of}.{name}\", offsetof({of}, {name}), {size});")
            });
        } else if let Some(value) = line.strip_prefix("#define MUSLIN_") {
            let name = value.split(' ').next().unwrap_or(value);
            lines.push(format!("print_value(\"MUSLIN_{name}\", MUSLIN_{name});"));
        } else if line.starts_with("MUSLIN_") && line.ends_with(',') {
            let name = line.split(' ').next().unwrap_or(line);
            lines.push(format!("print_value(\"{name}\", {name});"));
        }
    }
    format!(
        "#include <muslin.h>\n#include <stdio.h>\n\
         static void print(const char *what, size_t at, size_t size) {{\n\
         printf(\"%s: at %lu, %lu bytes\\n\", what, (unsigned long)at, (unsigned long)size);\n}}\n\
         static void print_value(const char *what, unsigned long value) {{\n\
         printf(\"%s = %lu\\n\", what, value);\n}}\n\
         int main(void) {{\n{}\nreturn 0;\n}}\n",
        lines.join("\n")
    )
}

/// The declarations of all functions, each on one line, sorted.
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
            "print_value(\"MUSLIN_A\", MUSLIN_A);",
            "print_value(\"MUSLIN_S_OK\", MUSLIN_S_OK);",
        ] {
            assert!(program.contains(line), "{program}");
        }
        let declared =
            ["MuslinStatus muslin_do(MuslinB b, uint32_t *out)", "const char *muslin_say(void)"];
        assert_eq!(functions(&header), declared);
    }

    #[test]
    fn a_change_is_refused_and_an_addition_must_be_recorded() {
        assert!(compare("a\nb\n", "a\nb\n").is_ok());
        let changed = compare("a\n  b: at 4\n", "a\n  b: at 8\n").unwrap_err().to_string();
        assert!(changed.contains("rely on: b: at 4"), "{changed}");
        assert!(
            compare("a\n", "a\nb\n")
                .unwrap_err()
                .to_string()
                .contains("lacks what the header adds")
        );
    }
}
