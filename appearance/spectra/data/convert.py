#!/usr/bin/python3
"""Writes the tables of this folder from two Debian packages; see README.md for what they are.

    apt-get install psychtoolbox-3-common r-cran-munsell python3-scipy
    /usr/bin/python3 appearance/spectra/data/convert.py

The program never runs this: the tables are committed and compiled in.
"""

import csv
import pathlib
import subprocess

import numpy as np
import scipy.io

HERE = pathlib.Path(__file__).parent
MAGNESIUM_OXIDE = 0.975  # luminance factor of the renotation's white [Newhall1943]


def packaged(package, suffix):
    """The one file of an installed Debian package whose path ends in suffix."""
    listing = subprocess.run(["dpkg", "-L", package], capture_output=True, text=True, check=True)
    (path,) = [line for line in listing.stdout.splitlines() if line.endswith("/" + suffix)]
    return path


def psychtoolbox(name):
    """Wavelengths (nm) and one column per curve; the stored big-endian types become plain double."""
    file = scipy.io.loadmat(packaged("psychtoolbox-3-common", name + ".mat"))
    first, step, count = (int(v) for v in file["S_" + name.split("_", 1)[1]].ravel())
    curves = file[name].astype(float)
    if curves.shape[0] != count:  # colour matching functions are stored as rows
        curves = curves.T
    return first + step * np.arange(count), curves, file


def number(value, digits=15):
    text = f"{value:.{digits}g}"
    return text if float(text) != 0 else "0"


def write(name, header, rows):
    with open(HERE / name, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def colour_matching(year):
    nm, xyz, _ = psychtoolbox("T_xyz" + year)
    write(f"cie{year}.csv", ["nm", "x", "y", "z"],
          ([w, *map(number, row)] for w, row in zip(nm, xyz)))


def alpha_opic():
    nm, lms, _ = psychtoolbox("T_cones_ss10")
    nm_rods, rods, _ = psychtoolbox("T_rods")
    write("alpha_opic.csv", ["nm", "S", "M", "L", "rods"],
          ([w, *map(number, [*lms[nm == w][0][::-1], rods[nm_rods == w][0][0]])]
           for w in range(390, 781, 5)))


def illuminants():
    nm, components, _ = psychtoolbox("B_cieday")
    nm_c, c, _ = psychtoolbox("spd_CIEC")
    assert (nm == nm_c).all()
    write("illuminants.csv", ["nm", "C", "S0", "S1", "S2"],
          ([w, *map(number, row)] for w, row in zip(nm, np.hstack([c, components]))))


def lamps():
    nm, power, file = psychtoolbox("spd_houser")
    labels = [" ".join(str(cell[0]).split()) for cell in file["labels_houser"][0]]
    write("houser_lamps.csv", ["name", "label", *nm],
          ([i, label, *(number(v, 7) for v in curve)]
           for i, (label, curve) in enumerate(zip(labels, power.T), 1)))


def renotation():
    with open(packaged("r-cran-munsell", "real.dat"), encoding="ascii") as file:
        rows = [line.split() for line in file if line.strip()][1:]
    return [f"{hue} {value}/{chroma}" for hue, value, chroma, *_ in rows], \
        np.array([row[3:] for row in rows], float)


def lab(xyz, white):
    f = np.where(xyz / white > (6 / 29) ** 3, np.cbrt(xyz / white),
                 xyz / white * (29 / 6) ** 2 / 3 + 4 / 29)
    return np.stack([116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], 1)


def nearest_chips(nm, reflectance, names, x_y_y):
    """For each paper the renotation chip nearest in CIELAB under C, the illuminant of both."""
    _, xyz, _ = psychtoolbox("T_xyz1931")
    nm_c, c, _ = psychtoolbox("spd_CIEC")
    weights = xyz[nm - 360] * c[np.searchsorted(nm_c, nm)]
    weights *= 100 / weights[:, 1].sum()
    x, y, luminance = x_y_y.T * [[1], [1], [MAGNESIUM_OXIDE]]
    white = weights.sum(0)
    papers = lab(reflectance.T @ weights, white)
    chips = lab(np.stack([x / y, np.ones_like(x), (1 - x - y) / y], 1) * luminance[:, None], white)
    return [names[np.argmin(((chips - paper) ** 2).sum(1))] for paper in papers]


def munsell():
    names, x_y_y = renotation()
    write("munsell_renotation.csv", ["name", "x", "y", "Y"],
          ([name, *map(number, row)] for name, row in zip(names, x_y_y)))

    nm, reflectance, _ = psychtoolbox("sur_nickerson")
    measured = (nm >= 400) & (nm <= 700)
    assert not reflectance[~measured].any(), "beyond 400..700 nm the source holds padding"
    nm, reflectance = nm[measured], reflectance[measured]
    near = nearest_chips(nm, reflectance, names, x_y_y)
    write("munsell_nickerson.csv", ["name", "label", *nm],
          ([f"{i:03}", "near " + chip, *(number(v, 6) for v in curve)]
           for i, (chip, curve) in enumerate(zip(near, reflectance.T), 1)))


if __name__ == "__main__":
    colour_matching("1931")
    colour_matching("1964")
    alpha_opic()
    illuminants()
    lamps()
    munsell()
