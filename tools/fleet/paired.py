# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Sums up each system, and compares it with the baseline drive by drive.

Both have run the same drives, so differences are tested in pairs, which takes out how hard a drive
is. Two tests are given: Wilcoxon's signed-rank test, exact for up to 50 pairs without ties, and the
exact sign test, which supposes nothing of the differences' distribution. Holm's correction of the
Wilcoxon p holds for all systems that are compared in one figure.
"""
import math
import statistics
import warnings

from scipy import stats

# The figures that are compared; less is better. NEES counts by its distance from 1 as a factor.
COMPARED = ("ape_m", "drift_percent", "end_percent", "nees_pose", "scan_median_ms")
MIN_PAIRS = 2


def cost(figure, value):
    """Returns what is compared: the figure, or for NEES |ln NEES|; None where there is none."""
    if value is None or not math.isfinite(value):
        return None
    if figure.startswith("nees"):
        return abs(math.log(value)) if value > 0 else None
    return value


def pairs_of(table, system, baseline, figure):
    """The costs of system and baseline on the drives where both have one."""
    costs = {(row["system"], row["drive"]): cost(figure, row[figure]) for row in table}
    drives = dict.fromkeys(row["drive"] for row in table)
    both = [(costs.get((system, drive)), costs.get((baseline, drive))) for drive in drives]
    return [pair for pair in both if None not in pair]


def wilcoxon_p(differences):
    """Two-sided; equal pairs are left out, as Wilcoxon did. It is 1 where all are equal."""
    kept = [value for value in differences if value != 0]
    if not kept:
        return 1.0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # scipy warns that few pairs with ties are approximated
        return float(stats.wilcoxon(kept, alternative="two-sided").pvalue)


def signed_rank_sum(differences):
    """Below 0 where the system tends to cost less: where Wilcoxon's test points."""
    kept = [value for value in differences if value != 0]
    ranks = stats.rankdata([abs(value) for value in kept])
    return float(sum(math.copysign(rank, value) for rank, value in zip(ranks, kept)))


def sign_p(num_better, num_worse):
    num = num_better + num_worse
    return float(stats.binomtest(num_better, num, 0.5).pvalue) if num else 1.0


def ratio(pairs):
    """The median of the drives' ratios; None where a cost of the baseline is 0."""
    if any(base <= 0 for _, base in pairs):
        return None
    return statistics.median(own / base for own, base in pairs)


def compare(table, system, baseline, figure):
    pairs = pairs_of(table, system, baseline, figure)
    result = {"num_pairs": len(pairs)}
    if len(pairs) < MIN_PAIRS:
        return result
    differences = [own - base for own, base in pairs]
    better, worse = sum(d < 0 for d in differences), sum(d > 0 for d in differences)
    return result | {"num_better": better, "num_worse": worse,
                     "median_difference": statistics.median(differences),
                     "median_ratio": ratio(pairs), "signed_rank_sum": signed_rank_sum(differences),
                     "wilcoxon_p": wilcoxon_p(differences),
                     "sign_p": sign_p(better, worse)}


def holm(p_values):
    """Corrects p values for their number, step by step, as Holm (1979) did."""
    order = sorted(range(len(p_values)), key=p_values.__getitem__)
    corrected, largest = [0.0] * len(p_values), 0.0
    for rank, index in enumerate(order):
        largest = max(largest, min(1.0, (len(p_values) - rank) * p_values[index]))
        corrected[index] = largest
    return corrected


def put_holm(comparisons, figure):
    tested = [system for system, found in comparisons.items() if "wilcoxon_p" in found[figure]]
    corrected = holm([comparisons[system][figure]["wilcoxon_p"] for system in tested])
    for system, value in zip(tested, corrected):
        comparisons[system][figure]["holm_p"] = value


def spread(values):
    values = sorted(value for value in values if value is not None)
    if not values:
        return None
    return {"count": len(values), "median": statistics.median(values),
            "mean": statistics.fmean(values), "max": values[-1]}


def count(rows, name):
    found = {}
    for row in rows:
        key = row[name] or "-"
        found[key] = found.get(key, 0) + 1
    return found


def summarize(table, systems, baseline):
    """One entry per system: counts, spreads of the figures, its comparison with the baseline."""
    comparisons = {system: {figure: compare(table, system, baseline, figure) for figure in COMPARED}
                   for system in systems if system != baseline}
    for figure in COMPARED:
        put_holm(comparisons, figure)
    summary = []
    for system in systems:
        rows = [row for row in table if row["system"] == system]
        figures = (*COMPARED, "ape_max_m", "coverage_ratio", "run_cpu_s", "rss_peak_mb")
        summary.append({"system": system, "num_runs": len(rows), "status": count(rows, "status"),
                        "trust": count(rows, "trust"),
                        "figures": {name: spread([row[name] for row in rows]) for name in figures},
                        "against_baseline": comparisons.get(system)})
    return summary
