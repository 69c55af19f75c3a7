"""Whether `immerse certify` and certify.py find the same events.

    python3 tests/certify/agree.py PROGRAM DIR       in the film or the OBJ files in DIR
    python3 tests/certify/agree.py PROGRAM 100000    in so many random intervals of a hinge, and its faces

PROGRAM is the built program. Prints how many intervals and events there were, or the first event that one of both does not have.
Half of the random hinges stand on a coarse grid, so that hinges lie in planes, touch, and fold on a frame exactly, and faces vanish.
"""
import contextlib, io, json, pathlib, random, subprocess, sys, tempfile
import certify

def compare(program, folder):
    """Certifies a folder twice; returns the events, or ends with the first difference."""
    done = subprocess.run([program, "certify", str(folder), "--quiet"], capture_output=True, text=True)
    if done.returncode not in (0, 1) or not (folder / "certificate.json").exists():
        sys.exit(done.stderr)
    with contextlib.redirect_stdout(io.StringIO()) as out:
        certify.main(folder)
    other, one = json.loads(out.getvalue()), json.loads((folder / "certificate.json").read_text())
    if not other["is_of_certificate"]:
        sys.exit(f"{folder}: the certificate is of other positions or faces")
    # What lasts may come in several stretches, of which certify.py says that there are some.
    name = lambda event: (event["frames"], event["kind"], sorted(event["vertices"]), event["lasts"])
    once = lambda events: [e for k, e in enumerate(events) if not e["lasts"] or k == 0 or name(events[k - 1]) != name(e)]
    lists = [once(sorted(said["events"], key=lambda e: (name(e), e["time"]))) for said in (one, other)]
    for a, b in zip(*lists):
        if name(a) != name(b) or (not a["lasts"] and not (a["time"][0] <= b["time"][1] and b["time"][0] <= a["time"][1])):
            sys.exit(f"{folder}: {a}\nis not {b}")
    if len(lists[0]) != len(lists[1]):
        sys.exit(f"{folder}: {len(lists[0])} events against {len(lists[1])}")
    return lists[0]

def write_hinges(folder, hinges, frames):
    """OBJ files of as many hinges that do not touch each other."""
    for frame in range(frames):
        lines = []
        for k in range(4 * hinges):
            # Of four hinges two are anywhere, one stands on a grid, and one on a grid in a plane.
            axes = [random.uniform] * 3 if k // 4 % 4 < 2 else [random.randint] * (3 - k // 4 % 4 // 3)
            place = [axis(-2, 2) / 2 for axis in axes] + [0.0] * (3 - len(axes))
            lines.append("v " + " ".join(map(repr, place)))
        for k in range(1, 4 * hinges, 4):
            lines += [f"f {k} {k + 1} {k + 2}", f"f {k + 1} {k} {k + 3}"]
        (folder / f"{frame:06}.obj").write_text("\n".join(lines) + "\n")

def main(program, what):
    if not what.isdigit():
        return print(len(compare(program, pathlib.Path(what))), "events")
    random.seed(1)
    hinges, left, kinds = 100, int(what), {}
    while left > 0:
        intervals = min(100, -(-left // hinges))
        with tempfile.TemporaryDirectory() as folder:
            write_hinges(pathlib.Path(folder), hinges, intervals + 1)
            for event in compare(program, pathlib.Path(folder)):
                kind = ("lasting " if event["lasts"] else "") + event["kind"]
                kinds[kind] = kinds.get(kind, 0) + 1
        left -= intervals * hinges
    print(int(what) - left, "intervals,", ", ".join(f"{kind}: {count}" for kind, count in sorted(kinds.items())))

if __name__ == "__main__":
    main(*sys.argv[1:])
