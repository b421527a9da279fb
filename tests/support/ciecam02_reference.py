#!/usr/bin/env python3
"""Writes tests/data/ciecam02_vectors.csv: CIECAM02 [CIE159] in 50 digits, as the standard prints it.

Nothing is cancelled or rearranged here, so that the program's rearranged form is judged by the plain
one. Needs python3-mpmath. Usage: ciecam02_reference.py > tests/data/ciecam02_vectors.csv
"""

import random

from mpmath import mp, mpf, matrix, atan2, cos, exp, pi, sqrt

mp.dps = 50

CAT02 = matrix([["0.7328", "0.4296", "-0.1624"], ["-0.7036", "1.6975", "0.0061"],
                ["0.0030", "0.0136", "0.9834"]])
HPE = matrix([["0.38971", "0.68898", "-0.07868"], ["-0.22981", "1.18340", "0.04641"], [0, 0, 1]])
UNIQUE_HUES = [(mpf(h), mpf(e)) for h, e in [("20.14", "0.8"), ("90", "0.7"), ("164.25", "1.0"),
                                             ("237.53", "1.2"), ("380.14", "0.8")]]

AVERAGE, DIM, DARK = (1.0, 0.69, 1.0), (0.9, 0.59, 0.9), (0.8, 0.525, 0.8)
# Rounded white points; they only need to be the same on both sides.
D65, A, E = (95.047, 100, 108.883), (109.85, 100, 35.585), (100, 100, 100)
D50, K7500, K9300, BLUE_SKY = ((96.422, 100, 82.521), (96.8, 100, 125.5), (97.1, 100, 141.2),
                               (100.1, 100, 196.4))


def compress(cone, f_l):
    power = (f_l * abs(cone) / 100) ** mpf("0.42")
    response = 400 * power / (power + mpf("27.13"))
    return (response if cone >= 0 else -response) + mpf("0.1")


def hue_quadrature(h):
    h = h + 360 if h < UNIQUE_HUES[0][0] else h
    i = max(k for k in range(4) if UNIQUE_HUES[k][0] <= h)
    (h_0, e_0), (h_1, e_1) = UNIQUE_HUES[i], UNIQUE_HUES[i + 1]
    past, ahead = (h - h_0) / e_0, (h_1 - h) / e_1
    return 100 * i + 100 * past / (past + ahead)


def ciecam02(xyz, white, l_a, y_b, surround):
    """Status and J, C, h, Q, M, s, H; None where the model is undefined."""
    xyz, white = matrix([mpf(v) for v in xyz]), matrix([mpf(v) for v in white])
    l_a, y_b = mpf(l_a), mpf(y_b)
    f, c, n_c = (mpf(v) for v in surround)
    rgb_w = CAT02 * white
    if min(l_a, y_b, white[1], min(rgb_w)) <= 0:
        return "DOMAIN", [None] * 7
    k = 1 / (5 * l_a + 1)
    f_l = mpf("0.2") * k**4 * 5 * l_a + mpf("0.1") * (1 - k**4) ** 2 * (5 * l_a) ** (mpf(1) / 3)
    n = y_b / white[1]
    n_bb = mpf("0.725") * (1 / n) ** mpf("0.2")
    z = mpf("1.48") + sqrt(n)
    d = f * (1 - exp((-l_a - 42) / 92) / mpf("3.6"))

    def responses(stimulus):
        rgb = CAT02 * stimulus
        adapted = matrix([(white[1] * d / rgb_w[i] + 1 - d) * rgb[i] for i in range(3)])
        cones = HPE * (CAT02**-1 * adapted)
        return [compress(cone, f_l) for cone in cones], min(cones)

    def achromatic(r):
        return (2 * r[0] + r[1] + r[2] / 20 - mpf("0.305")) * n_bb

    r, least_cone = responses(xyz)
    a_w, achromatic_response = achromatic(responses(white)[0]), achromatic(r)
    a = r[0] - 12 * r[1] / 11 + r[2] / 11
    b = (r[0] + r[1] - 2 * r[2]) / 9
    black = max(abs(v) for v in xyz) == 0
    h = mpf(0) if black else atan2(b, a) % (2 * pi)
    h_deg = 180 * h / pi
    # Exactly zero in the standard's form; 50 digits leave a rounding of the offset 0.1.
    achromatic_response = mpf(0) if black else achromatic_response
    denominator = r[0] + r[1] + mpf("1.05") * r[2]

    flags = [name for holds, name in [(not black and least_cone < 0, "NEGCONE"),
                                      (achromatic_response < 0, "A_NEG"),
                                      (denominator <= 0, "TDEN")] if holds]
    status = "+".join(flags) or "OK"
    quadrature = hue_quadrature(h_deg)
    if achromatic_response < 0:
        return status, [None, None, h_deg, None, None, None, quadrature]
    j = 100 * (achromatic_response / a_w) ** (c * z)
    q = 4 / c * sqrt(j / 100) * (a_w + 4) * f_l ** mpf("0.25")
    if denominator <= 0:
        return status, [j, None, h_deg, q, None, None, quadrature]
    e_t = (cos(h + 2) + mpf("3.8")) / 4
    t = mpf(50000) / 13 * n_c * n_bb * e_t * (mpf(0) if black else sqrt(a * a + b * b)) / denominator
    chroma = t ** mpf("0.9") * sqrt(j / 100) * (mpf("1.64") - mpf("0.29") ** n) ** mpf("0.73")
    m = chroma * f_l ** mpf("0.25")
    s = 100 * sqrt(m / q) if q > 0 else mpf(0)
    return status, [j, chroma, h_deg, q, m, s, quadrature]


def cases():
    """(category, XYZ, white, L_A, Y_b, surround)"""
    # The four examples that go with the model: D65 and A, 318.31 and 31.83 cd/m^2 [CIE159].
    examples_d65, examples_a = (95.05, 100, 108.88), (109.85, 100, 35.58)
    yield "published", (19.01, 20.0, 21.78), examples_d65, 318.31, 20, AVERAGE
    yield "published", (57.06, 43.06, 31.96), examples_d65, 31.83, 20, AVERAGE
    yield "published", (3.53, 6.56, 2.14), examples_a, 318.31, 20, AVERAGE
    yield "published", (19.01, 20.0, 21.78), examples_a, 31.83, 20, AVERAGE

    draw = random.Random(20040101)
    for _ in range(80):
        scale = draw.choice([1, 0.9, 0.5])  # Y_w need not be 100
        white = tuple(scale * w for w in draw.choice([D65, A, E, D50, K7500, (190, 100, 2)]))
        xyz = tuple(round(w * draw.uniform(0.02, 1), 6) for w in white)
        yield ("random", xyz, white, round(10 ** draw.uniform(-1, 4), 4),
               round(draw.uniform(2, 80), 4), draw.choice([AVERAGE, DIM, DARK, (0.95, 0.64, 0.95)]))

    yield "black", (0, 0, 0), D65, 100, 20, AVERAGE
    yield "black", (0, 0, 0), A, 0.01, 20, DARK
    for white in (D65, A):
        for size in (1e-4, 1e-7, 1e-10):
            yield "dark_neutral", tuple(size / 100 * w for w in white), white, 100, 20, AVERAGE
            tinted = (1.3 * size, size, 0.4 * size)
            yield "dark_chromatic", tinted, white, 100, 20, AVERAGE
    for white in (D65, A, E, D50):
        yield "white", white, white, 318.31, 20, AVERAGE
        for tint in (1e-3, 1e-6, 1e-9):
            yield ("near_white", (white[0] * (1 + tint), white[1], white[2] * (1 - tint)), white,
                   318.31, 20, AVERAGE)
    yield "above_white", (180, 120, 30), A, 318.31, 20, AVERAGE
    yield "above_white", (9504.7, 10000, 10888.3), D65, 318.31, 20, AVERAGE
    yield "above_white", (6e5, 4e5, 1e5), A, 318.31, 20, AVERAGE
    for l_a in (1e-3, 1, 1e3, 1e6):
        yield "L_A_sweep", (30, 22, 8), D65, l_a, 20, AVERAGE
    for y_b in (1e-9, 0.01, 100):
        yield "Y_b_sweep", (30, 22, 8), D65, 100, y_b, AVERAGE
    # Chromaticities near the spectrum locus at 400, 450, 480, 500, 520, 570, 600, 650 nm.
    for x, y in ((0.1733, 0.0048), (0.1566, 0.0177), (0.0913, 0.1327), (0.0082, 0.5384),
                 (0.0743, 0.8338), (0.4441, 0.5547), (0.6270, 0.3725), (0.7260, 0.2740)):
        for big_y in (0.05, 1, 20):
            yield ("monochromatic", (big_y * x / y, big_y, big_y * (1 - x - y) / y), D65, 318.31,
                   20, AVERAGE)
    # Saturated blues under bluish whites: the achromatic response goes below zero.
    for xyz, white in (((3.756, 0.1218, 18.101), K7500), ((11.475, 0.5531, 56.384), K9300),
                       ((26.448, 1.9887, 133.84), BLUE_SKY), ((33.025, 4.9415, 176.26), BLUE_SKY),
                       ((10.359, 0.59, 51.406), D65)):
        yield "optimal_blue", xyz, white, 318.31, 20, AVERAGE
    for xyz in ((64, 10, -36), (0.5, -33, 21), (0, 0, 1), (20, 5, 110), (1, 1, -0.5)):
        yield "imaginary", xyz, D65, 318.31, 20, AVERAGE
    yield "domain", (30, 22, 8), D65, 100, 0, AVERAGE
    yield "domain", (30, 22, 8), D65, 0, 20, AVERAGE
    yield "domain", (30, 22, 8), (95, 0, 108), 100, 20, AVERAGE
    yield "domain", (83, 30, 0), (276.9, 100, 0), 318.31, 20, AVERAGE


def main():
    print("category,status,X,Y,Z,Xw,Yw,Zw,L_A,Y_b,F,c,N_c,J,C,h_deg,Q,M,s,H")
    for category, xyz, white, l_a, y_b, surround in cases():
        status, correlates = ciecam02(xyz, white, l_a, y_b, surround)
        inputs = [repr(float(v)) for v in (*xyz, *white, l_a, y_b, *surround)]
        outputs = ["" if v is None else mp.nstr(v, 17, strip_zeros=True) for v in correlates]
        print(",".join([category, status, *inputs, *outputs]))


if __name__ == "__main__":
    main()
