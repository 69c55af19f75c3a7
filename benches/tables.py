"""Markdown that reads well as it is, on the screen and in a file."""

import math

report = []


def say(text=""):
    report.append(text)
    print(text, flush=True)


def table(head, rows):
    """Rows of text, aligned: Markdown that reads well as it is."""
    rows = [[str(cell) for cell in row] for row in rows]
    widths = [max(len(row[k]) for row in [head, *rows]) for k in range(len(head))]
    line = lambda row: "| " + " | ".join(cell.ljust(width) for cell, width in zip(row, widths)) + " |"
    say(line(head))
    say("|" + "|".join("-" * (width + 2) for width in widths) + "|")
    for row in rows:
        say(line(row))
    say()


def seconds(value):
    return f"{value * 1e3:.0f} ms" if value < 1 else f"{value:.1f} s" if value < 100 else f"{value:.0f} s"


def exponent(by_faces):
    """p of time ~ faces^p between the two largest sizes."""
    (small, a), (large, b) = sorted(by_faces.items())[-2:]
    return math.log(b / a) / math.log(large / small)
