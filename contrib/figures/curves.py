"""The curves of a parameter file, and the runs they come from.

The head of the file has the lines

    # program: NAME of a program in examples
    # panel: LABEL: ENTRY = VALUE; ...    any number of them, or none
    # curve: LABEL: ENTRY = VALUE; ...
    # small: ENTRY = VALUE; ...           what makes a run one of seconds

There is a curve for each line 'curve' in each panel."""

import shutil
from pathlib import Path

from cases import entries, head, read_table, values, with_entries

TABLES = {"rheometer": "steady_shear.csv"}


def identity(text):
    """What two runs have in common if they are the same one."""
    result = values(text)
    if result["Fluid/Model"] == "newtonian":
        # which has no other parameters
        result = {k: v for k, v in result.items()
                  if not k.startswith("Fluid/") or k == "Fluid/Model"}
    return frozenset(result.items())


class Run:
    """One run of a program and what its folder holds."""

    def __init__(self, folder, program, text):
        self.folder = folder
        self.program = program
        self.text = text
        self.values = values(text)
        self.name = f"{folder.parent.name}/{folder.name}"
        self.file = folder / "run.prm"
        self.log = folder / "log.txt"
        self.times = folder / "seconds.txt"
        self.results = folder / "results"
        self.table = self.results / TABLES.get(program, "trajectory.csv")

    def length(self):
        """The strain it goes to, 0 for a table of steady states."""
        return float(self.values.get("Time/Final strain", 0.))

    def cost(self):
        """What its time is proportional to, roughly."""
        if not self.length():
            return 0.
        return (self.length() / float(self.values["Time/Time step"])
                * float(self.values["Mesh/Elements on equator"]) ** 3)

    def strain(self):
        """Where it has got to, or nothing before its first row."""
        try:
            with open(self.table, "rb") as file:
                file.seek(max(0, file.seek(0, 2) - 4096))
                # the last row may be written right now
                return float(file.read().split(b"\n")[-2].split(b",")[0])
        except (OSError, IndexError, ValueError):
            return None

    def state(self):
        """complete, interrupted or missing. Results of other parameters count
        for nothing."""
        if not self.file.exists() or \
                identity(self.file.read_text()) != identity(self.text):
            return "missing"
        if self.length():
            strain = self.strain()
            if strain is not None and strain >= self.length() - 1e-6:
                return "complete"
        elif self.table.exists():
            return "complete"
        return "interrupted" if any(self.results.glob("checkpoint_[01]")) \
            else "missing"

    def prepare(self):
        """Make its folder ready and return whether it is to be resumed."""
        resumed = self.state() == "interrupted"
        if not resumed:
            shutil.rmtree(self.folder, ignore_errors=True)
            self.folder.mkdir(parents=True)
        self.file.write_text(self.text)
        return resumed

    def rows(self):
        """Its table, as far as there is one of these parameters."""
        if self.state() == "missing" or self.strain() is None:
            return []
        rows = read_table(self.table)
        # the last row may be written right now
        return rows if None not in rows[-1].values() else rows[:-1]

    def seconds(self):
        """Processor seconds over all the times it was started."""
        if not self.times.exists():
            return 0.
        return sum(map(float, self.times.read_text().split()))


class Curve:
    def __init__(self, panel, label, run):
        self.panel = panel
        self.label = label
        self.run = run


def choices(lines, key):
    """Label and entries of the lines of a key."""
    result = []
    for name, value in lines:
        if name == key:
            label, colon, changes = value.partition(": ")
            if not colon:
                raise SystemExit(f"'# {key}: {value}' has no label: write "
                                 f"'# {key}: LABEL: SECTION/NAME = VALUE'")
            result.append((label, entries(changes)))
    return result


def word(label):
    return label.replace(" = ", "_").replace(" ", "_")


class Plan:
    """All curves. What has the same parameters is one run."""

    def __init__(self, parameters, folder, small):
        self.folder = folder
        self.small = small
        self.parameters = parameters
        self.runs = {}
        self.curves = {}

    def add(self, name):
        """Read the file of that name."""
        text = (self.parameters / f"{name}.prm").read_text()
        lines = head(text)
        program = dict(lines)["program"]
        small = [e for key, value in lines if key == "small" and self.small
                 for e in entries(value)]
        self.curves[name] = []
        for panel, of_panel in choices(lines, "panel") or [("", [])]:
            for label, of_curve in choices(lines, "curve"):
                body = with_entries(text, of_panel + of_curve + small)
                place = self.folder / name / word(f"{panel} {label}".strip())
                run = self.runs.setdefault((program, identity(body)),
                                           Run(place, program, body))
                self.curves[name].append(Curve(panel, label, run))
