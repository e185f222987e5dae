#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Writes the bash completion of a program from its own --help: completion.py PROGRAM OUT.

The options, their values and the subcommands are those that the program has, so that the completion
cannot say otherwise. With bashcompinit zsh reads the same file.
"""
import pathlib
import re
import subprocess
import sys

OPTION = re.compile(r"^  ((?:-\w,)?--[\w-]+)(?: (\S+))?")
SUBCOMMAND = re.compile(r"^  ([a-z][\w-]*) {2,}\S")
SHELL = """\
# Bash completion of {name}, made from its --help.
{function}() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} command="" word
  local -a words=()
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    [[ " {subcommands} " == *" $word "* ]] && command=$word && break
  done
  COMPREPLY=()
  case "$command $prev" in
{values}    *) ;;
  esac
  if [[ $cur == -* ]]; then
    case $command in
{options}    esac
    mapfile -t COMPREPLY < <(compgen -W "${{words[*]}}" -- "$cur")
  elif [[ -z $command && -n "{subcommands}" ]]; then
    mapfile -t COMPREPLY < <(compgen -W "{subcommands}" -- "$cur")
    compopt -o default
  else
    compopt -o default
  fi
}}
complete -F {function} {name}
"""


def help_of(program, *subcommand):
    return subprocess.run([program, *subcommand, "--help"], check=True, capture_output=True,
                          text=True).stdout


def options_of(text):
    """Name to the kind of its value; None: it takes none."""
    found = {}
    for line in text.splitlines():
        if match := OPTION.match(line):
            kind = match.group(2)
            is_padded = line[match.end(1):].startswith("  ")
            for name in match.group(1).split(","):
                found[name] = None if is_padded else kind
    return found


def subcommands_of(text):
    part = text.partition("\nSubcommands:\n")[2]
    names = []
    for line in part.splitlines():
        if line[:1].strip():  # the next section
            break
        if match := SUBCOMMAND.match(line):
            names.append(match.group(1))
    return names


def values_of(command, options):
    """Branches for an option that the word before is: it wants one of a few words, or any."""
    branches = ""
    for name, kind in options.items():
        if kind is None:
            continue
        pattern = f"'{command} {name}'"
        if re.fullmatch(r"\w+(\|\w+)+", kind):
            words = kind.replace("|", " ")
            action = f'mapfile -t COMPREPLY < <(compgen -W "{words}" -- "$cur")'
        elif re.search(r"FILE|DIR|MAP|\.\w+", kind):
            action = "compopt -o default"
        else:
            action = ":"
        branches += f"    {pattern}) {action} && return ;;\n"
    return branches


def main():
    program, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    text = help_of(program)
    subcommands = subcommands_of(text)
    options = {"": options_of(text)} | {name: options_of(help_of(program, name))
                                        for name in subcommands}
    lists = "".join(f"      '{command}') words=({' '.join(names)}) ;;\n"
                    for command, names in options.items())
    values = "".join(values_of(command, names) for command, names in options.items())
    out.write_text(SHELL.format(name=program.name, subcommands=" ".join(subcommands),
                                function="_" + program.name.replace("-", "_"), values=values,
                                options=lists), encoding="utf-8")


if __name__ == "__main__":
    main()
