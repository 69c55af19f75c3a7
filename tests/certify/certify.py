"""Whether a film is a regular homotopy: a second opinion on `immerse certify DIR`, by other means.

    python3 tests/certify/certify.py DIR

DIR is the folder of a film, or one of OBJ files with the same triangles, in the order of their names. Vertices move on straight
lines from frame to frame. What floating point numbers with a bound of their errors do not settle is decided in integers and fractions, by Sturm's
sequences. Prints one JSON object with all events; if DIR has a certificate.json, it also says whether that is of the same numbers.
Frames and times are as there, vertices count as in the mesh file, from 0.
"""
import hashlib, json, math, pathlib, sys
from fractions import Fraction
import numpy

def read(folder):
    """Triangles, names of vertices, and the positions of all frames."""
    if (folder / "mesh.npz").exists():
        mesh = numpy.load(folder / "mesh.npz")
        frames = [numpy.load(path)["positions"] for path in sorted(folder.glob("frames/*.npz"))]
        return mesh["triangles"].astype(int), mesh["file_vertex"].astype(int), frames
    films = [[line.split() for line in path.read_text().splitlines()] for path in sorted(folder.glob("*.obj"))]
    triangles = [[int(word.split("/")[0]) - 1 for word in line[1:]] for line in films[0] if line[:1] == ["f"]]
    frames = [numpy.array([[float(x) for x in line[1:4]] for line in film if line[:1] == ["v"]]) for film in films]
    return numpy.array(triangles), numpy.arange(len(frames[0])), frames

def hinges(triangles):
    """Vertices a, b, c, d of all pairs of faces (a, b, c) and (b, a, d)."""
    opposite = {(f[k], f[k - 2]): f[k - 1] for f in triangles.tolist() for k in range(3)}
    pairs = [(a, b, c, opposite[b, a]) for (a, b), c in opposite.items() if a < b and (b, a) in opposite]
    return numpy.array(pairs, int).reshape(-1, 4)

# Polynomials in time are lists of coefficients, the constant one first; of numbers or of arrays of them.
def times(f, g):
    product = [0] * (len(f) + len(g) - 1)
    for i, x in enumerate(f):
        for j, y in enumerate(g):
            product[i + j] = product[i + j] + x * y
    return product

def plus(f, g, sign=1):
    return [x + sign * y for x, y in zip(f, g)]

def cross(a, b, sign=-1):
    return [plus(times(a[k - 2], b[k - 1]), times(a[k - 1], b[k - 2]), sign) for k in range(3)]

def dot(a, b):
    return plus(plus(times(a[0], b[0]), times(a[1], b[1])), times(a[2], b[2]))

def forms(corners, sign=-1):
    """Of a hinge the volume and the product of normals, of a face its normal; corners are vectors of polynomials."""
    sides = [[plus(x, y, sign) for x, y in zip(corner, corners[0])] for corner in corners[1:]]
    normal = cross(sides[0], sides[1], sign)
    return (dot(normal, sides[2]), dot(normal, cross(sides[2], sides[0], sign))) if len(sides) == 3 else normal

def may_happen(elements, start, end):
    """Those of hinges or faces that floating point numbers do not settle. Coefficients are those of (1 - t)^(n - k) t^k."""
    corners = [[[start[column, k], end[column, k]] for k in range(3)] for column in elements.T]
    sizes = [[[abs(x) for x in axis] for axis in corner] for corner in corners]
    found, errors = forms(corners), forms(sizes, 1)
    if elements.shape[1] == 3:
        found, errors = [dot(found, found)], [dot(errors, errors)]
    # Fewer than ninety roundings of 2^-53 each, relative to the sum of the sizes of all terms.
    pairs = [(numpy.array(f), 1e-14 * numpy.array(e) + 1e-290) for f, e in zip(found, errors)]
    safe = (pairs[-1][0] > pairs[-1][1]).all(0)
    if elements.shape[1] == 4:
        safe |= (pairs[0][0] > pairs[0][1]).all(0) | (pairs[0][0] < -pairs[0][1]).all(0)
    return elements[~safe]

# In integers. Polynomials count up to a positive factor, times are fractions.
def trim(f):
    while f and f[-1] == 0:
        f = f[:-1]
    factor = math.gcd(*f)
    return [x // factor for x in f]

def remainder(f, g):
    while len(f) >= len(g):
        scale, leading = abs(g[-1]), f[-1] if g[-1] > 0 else -f[-1]
        below = len(f) - len(g)
        f = [x * scale - (leading * g[k - below] if k >= below else 0) for k, x in enumerate(f)][:-1]
    return trim(f)

def without(f, t):
    """Divides by the factor with the root t."""
    quotient = [Fraction(f[-1])]
    for x in f[-2:0:-1]:
        quotient.append(x + t * quotient[-1])
    quotient.reverse()
    scale = math.lcm(*(x.denominator for x in quotient))
    return trim([int(x * scale) for x in quotient])

def at(f, t):
    """The value at t, times a positive number."""
    n = len(f) - 1
    return sum(x * t.numerator**k * t.denominator ** (n - k) for k, x in enumerate(f))

def query(f, g, a, b):
    """The sum of the signs of g over the different roots of f between a and b, which are none (Tarski)."""
    sequence = [f, trim(times([k * x for k, x in enumerate(f)][1:] or [0], g))]
    while sequence[-1]:
        sequence.append([-x for x in remainder(sequence[-2], sequence[-1])])
    changes = []
    for t in (a, b):
        signs = [value > 0 for value in (at(h, t) for h in sequence) if value != 0]
        changes.append(sum(x != y for x, y in zip(signs, signs[1:])))
    return changes[0] - changes[1]

def roots(f, gate, a, b):
    """Brackets of the roots of f between a and b at which gate is negative."""
    for end in (a, b):
        while at(f, end) == 0:
            f = without(f, end)
    count = (query(f, times(gate, gate), a, b) - query(f, gate, a, b)) // 2
    if count == 1 and query(f, [1], a, b) == 1 and at(f, a) * at(f, b) < 0:
        while b - a >= 1e-4:  # The only root of all: signs tell on which side it is.
            m = (a + b) / 2
            if at(f, m) == 0:
                return [(m, m)]
            a, b = (m, b) if (at(f, m) < 0) == (at(f, a) < 0) else (a, m)
    if count == 0 or (count == 1 and b - a < 1e-4):
        return [(a, b)] * count
    m = (a + b) / 2
    return roots(f, gate, a, m) + here(f, gate, m) + roots(f, gate, m, b)

def here(f, gate, t):
    return [(t, t)] if at(f, t) == 0 and at(gate, t) < 0 else []

def happens(places, is_first):
    """When a hinge folds or a face vanishes: brackets, and whether that lasts."""
    zero, one, always = Fraction(0), Fraction(1), [-1]
    scale = math.lcm(*(Fraction(x).denominator for corner in places for place in corner for x in place))
    whole = lambda x: int(Fraction(x) * scale)
    exact = [[[whole(x), whole(y) - whole(x)] for x, y in zip(*corner)] for corner in places]
    if len(places) == 4:
        f, gate = (trim(g) for g in forms(exact))
        if not f:  # It stays in a plane: is the gate negative anywhere?
            ends = [t for root in roots(gate, always, zero, one) for t in root] if gate else []
            ends = [zero, *ends, one]
            samples = ends + [(x + y) / 2 for x, y in zip(ends, ends[1:])]
            return [(zero, one)] if any(at(gate, t) < 0 for t in samples) else [], True
    else:
        f, gate = [], always
        for g in map(trim, forms(exact)):
            while g:
                f, g = g, remainder(f, g)
        if not f:
            return [(zero, one)], True
    return (here(f, gate, zero) if is_first else []) + roots(f, gate, zero, one) + here(f, gate, one), False

def main(folder):
    triangles, names, frames = read(folder)
    events, kinds = [], [("fold", hinges(triangles)), ("face", triangles)]
    for k, (start, end) in enumerate(zip(frames, frames[1:])):
        for kind, elements in kinds:
            for element in may_happen(elements, start, end).tolist():
                brackets, lasts = happens([(start[v].tolist(), end[v].tolist()) for v in element], k == 0)
                vertices = [int(names[v]) for v in element]
                for a, b in brackets:
                    events.append(dict(frames=[k + 1, k + 2], kind=kind, vertices=vertices, lasts=lasts, time=[float(a), float(b)]))
    said = dict(frames=len(frames), is_without_events=not events, events=events)
    if (folder / "certificate.json").exists():
        certificate = json.loads((folder / "certificate.json").read_text())
        sha256 = lambda array, kind: hashlib.sha256(array.astype(kind).tobytes()).hexdigest()
        of_frames = [frame["positions_sha256"] for frame in certificate["frames"]] == [sha256(p, "<f8") for p in frames]
        said["is_of_certificate"] = of_frames and certificate["triangles_sha256"] == sha256(triangles, "<u4")
    json.dump(said, sys.stdout)

if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
