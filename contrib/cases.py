"""What the scripts that run parameter files have in common.

The head of such a file says what to do with it in lines '# KEY: VALUE'. Entries
are written SECTION/NAME = VALUE, several of them separated by semicolons."""

import csv
import os
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Elements on the equators and across the gap of the meshes of the paper
MESHES = {"M1": (32, 1), "M2": (64, 2), "M3": (96, 3), "M4": (128, 4)}

# A run on one core, with memory in huge pages where the system leaves that to
# programs: new memory is cheaper then
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1",
               "DEAL_II_NUM_THREADS": "1",
               "GLIBC_TUNABLES": "glibc.malloc.hugetlb=1"}


def machine():
    """The processor and its cores, for tables of seconds."""
    names = [line.split(":")[1].strip() for line in open("/proc/cpuinfo")
             if line.startswith("model name")]
    return f"{names[0] if names else 'unknown processor'}, " \
           f"{os.cpu_count()} cores"


def read_table(path):
    """Rows of a table by the names of its columns without units."""
    with open(path) as file:
        rows = list(csv.DictReader(l for l in file if not l.startswith("#")))
    return [{re.sub(r" \[.*\]$", "", k): v for k, v in row.items()}
            for row in rows]


def write_table(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def head(text):
    """Pairs of key and value of the lines '# KEY: VALUE'."""
    return re.findall(r"^# (\w+): (.*?)\s*$", text, re.M)


def entries(text):
    """Pairs of name and value from SECTION/NAME = VALUE; ..."""
    result = []
    for entry in text.split(";"):
        name, equals, value = map(str.strip, entry.partition("="))
        if not (name and equals):
            raise SystemExit(f"'{entry.strip()}' is not SECTION/NAME = VALUE")
        result.append((name, value))
    return result


def with_entries(text, changes):
    """A parameter file with other values of some entries."""
    for name, value in changes:
        *sections, entry = name.split("/")
        text += "".join(f"subsection {s}\n" for s in sections)
        text += f"set {entry} = {value}\n" + "end\n" * len(sections)
    return text


def values(text):
    """The entries a parameter file sets, by SECTION/NAME."""
    result, sections = {}, []
    for line in text.splitlines():
        words = line.split("#")[0].split(maxsplit=1)
        if not words:
            continue
        if words[0] == "subsection":
            sections.append(words[1].strip())
        elif words[0] == "end":
            sections.pop()
        elif words[0] == "set":
            name, value = words[1].split("=", 1)
            result["/".join([*sections, name.strip()])] = value.strip()
    return result
