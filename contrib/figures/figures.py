"""What is in each figure: the parameter files it takes its curves from, and what
is drawn of them."""

import matplotlib.pyplot as plt

from cases import write_table
from outcomes import filled, markdown, outcome, thinned_curves
from style import save
import line_drawings
import stress_maps

STRAIN = ("strain", r"strain $\dot\gamma t$")
THETA = ("theta", r"$\theta$ [deg]", None)
# a pair or a string that passes leaves the panel at its top
SMALL_THETA = (*THETA[:2], (0., 45.))
FORCE = ("F_r", r"$F_r/F_S$", None)
SPIN = ("omega_0", r"$\omega/\dot\gamma$", None)
MIDDLE = ("omega_0", r"$\omega_\mathrm{middle}/\dot\gamma$", None)
OUTER = ("omega_1", r"$\omega_\mathrm{outer}/\dot\gamma$", None)
S = ("S", r"$S = N_1/2\sigma_{xy}$", None)
VISCOSITY = ("viscosity", r"$\eta/\eta_0$", None)


class Lines:
    """Curves against strain or rate, those of one panel of the files or all."""

    def __init__(self, files, quantities, panel=None, abscissa=STRAIN,
                 scale="linear"):
        self.files = files
        self.quantities = quantities
        self.panel = panel
        self.abscissa = abscissa
        self.scale = scale

    def curves(self, plan):
        return [c for f in self.files for c in plan.curves[f]
                if self.panel in (None, c.panel)]

    def make(self, plan, output):
        curves = self.curves(plan)
        table = filled(thinned_curves(curves))
        if not table:
            return None
        write_table(output.with_name(output.name + ".csv"), table)
        save(line_drawings.draw(curves, self.abscissa, self.quantities,
                                self.scale), output)
        if self.abscissa is not STRAIN:
            return ""
        rows = filled([outcome(c) for c in curves])
        write_table(output.with_name(output.name + "_outcomes.csv"), rows)
        return markdown(rows)


class Maps:
    """The stress in one curve of each file: at all strains of its fields, or at
    the gap and the last one."""

    def __init__(self, files, curve, half_size, largest_shown, n_columns,
                 close_up=False):
        self.files = files
        self.curve = curve
        self.half_size = half_size
        self.largest_shown = largest_shown
        self.n_columns = n_columns
        self.close_up = close_up

    def curves(self, plan):
        return [c for f in self.files for c in plan.curves[f]
                if c.label == self.curve]

    def make(self, plan, output):
        maps = []
        for curve in self.curves(plan):
            run = curve.run
            written = stress_maps.fields(run)
            for strain, path in written[-1:] if self.close_up else written:
                title = (run.program.replace("_", " ") if self.close_up
                         else f"strain {strain:.3g}")
                maps.append((title, run, strain, path, self.close_up))
        if not maps:
            return None
        figure, rows = stress_maps.draw(maps, self.half_size,
                                        self.largest_shown, self.n_columns)
        with plt.rc_context({"savefig.dpi": 150}):
            save(figure, output, (".png",))
        write_table(output.with_name(output.name + ".csv"), rows)
        return markdown(rows)


FIGURES = {
    "7": Lines(["figure_7_meshes", "figure_7_steps"], [SMALL_THETA, OUTER]),
    "8": Lines(["figure_8"], [SMALL_THETA]),
    "9": Lines(["figure_9"], [SMALL_THETA, FORCE, SPIN]),
    "10": Maps(["figure_9"], "Wi = 3", (4., 2.5), 40., 3),
    "11": Lines(["figure_11"], [SMALL_THETA, FORCE, MIDDLE, OUTER]),
    "12": Maps(["figure_11"], "Wi = 3", (5., 2.5), 40., 3),
    "13": Maps(["figure_9", "figure_11"], "Wi = 3", (0.6, 0.45), 50., 2,
               close_up=True),
    "14": Lines(["figure_14"], [S], abscissa=("rate", "Wi")),
    "17": Lines(["figure_17"], [VISCOSITY], scale="log",
                abscissa=("rate", r"$\lambda_c\dot\gamma$")),
    "18": Lines(["figure_18"], [THETA]),
    "18_pairs": Lines(["figure_18_pairs"], [THETA]),
    "19": Lines(["figure_18"], [MIDDLE, OUTER, FORCE], "lambda_c gamma = 10"),
    "19_pairs": Lines(["figure_18_pairs"], [SPIN, FORCE],
                      "lambda_c gamma = 10"),
    "meshes": Lines(["meshes_figure_8", "meshes_figure_9", "meshes_figure_11"],
                    [SMALL_THETA]),
    "meshes_18": Lines(["meshes_figure_18"], [THETA, OUTER, FORCE]),
    "choices": Lines(["choices"], [THETA, OUTER]),
}


def file_name(figure):
    return f"figure_{figure}" if figure[0].isdigit() else figure
