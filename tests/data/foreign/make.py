#!/usr/bin/env python3
"""Made the files of this folder: one load cycle as other programs write it. Synthetic; nobody measured it.

    pip install numpy scipy openpyxl nptdms h5py pyuff && python3 make.py

The same 120 rows everywhere: time k/10 s, force 1000 sin(k/10) N, displacement of a spring of 2 N/um with a
little scatter, rounded to 4 decimals. `frf_type4.uff` holds the accelerance of one mode (10 Hz, 2 %, 5 kg).
"""
import re
import zipfile
import h5py
import numpy as np
import openpyxl
import pyuff
import scipy.io
from nptdms import ChannelObject, GroupObject, RootObject, TdmsWriter

k = np.arange(120)
time = np.round(k / 10, 4)
force = np.round(1000 * np.sin(k / 10), 4)
weg = np.round(500 * np.sin(k / 10) + 0.2 * ((k * 7919) % 13), 4)
table = np.column_stack([time, force, weg])

# Spreadsheet: a sheet of remarks, then titles in line 4, a column of words, an empty line at the end.
book = openpyxl.Workbook()
book.active.title = "Info"
book.active.append(["Prüfer", "M. Muster"])
book.active.append(["Achse", 2])
sheet = book.create_sheet("Messung")
sheet["A1"] = "Messung Achse 2"
for column, title in enumerate(["Zeit [s]", "Kraft [N]", "Weg [µm]", "Bemerkung"], 1):
    sheet.cell(4, column, title)
for row, values in enumerate(table.tolist(), 5):
    for column, value in enumerate(values, 1):
        sheet.cell(row, column, value)
    sheet.cell(row, 4, "gut" if row % 2 else None)
book.save("cycle.xlsx")

# The same with the extent of its sheet told backwards, as no program does: readers count below nothing.
with zipfile.ZipFile("cycle.xlsx") as good, zipfile.ZipFile("reversed.xlsx", "w", zipfile.ZIP_DEFLATED) as spoiled:
    for name in good.namelist():
        text = good.read(name)
        if name.startswith("xl/worksheets/sheet"):
            text = re.sub(rb'<dimension ref="([A-Z0-9]+):([A-Z0-9]+)"', rb'<dimension ref="\2:\1"', text)
        spoiled.writestr(zipfile.ZipInfo(name, (2026, 1, 1, 0, 0, 0)), text)

# NumPy: named columns, plain columns in either order, big-endian.
named = np.zeros(len(k), dtype=[("time_s", "<f8"), ("force_N", "<f4"), ("displacement_um", "<f8")])
named["time_s"], named["force_N"], named["displacement_um"] = time, force, weg
np.save("named.npy", named)
np.save("plain.npy", table)
np.save("fortran.npy", np.asfortranarray(table.astype(">f8")))

# MATLAB 5: vectors, compressed and not; a structure with a matrix beside scalars and words; 7.3.
scipy.io.savemat("vectors.mat", {"time_s": time, "force_N": force, "displacement_um": weg, "axis": 2.0},
                 do_compression=True, oned_as="column")
scipy.io.savemat("structure.mat", {"measured": {"Zeit_s": time, "Kraft_N": force.astype(np.float32), "Weg_um": weg,
                                                "operator": "M. Muster"}, "rate": 10.0}, oned_as="row")
with h5py.File("v73.mat", "w", userblock_size=512) as file:
    file["time_s"] = time
with open("v73.mat", "r+b") as file:
    file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(116) + b" " * 8 + b"\x00\x02IM")

# TDMS: wave forms in two segments with units; and a channel of times.
half = len(k) // 2
with TdmsWriter("wave.tdms") as writer:
    for part in (slice(0, half), slice(half, None)):
        channels = [
            ChannelObject("Achse 2", name, data[part], {"unit_string": unit, "wf_increment": 0.1, "wf_start_offset": 0.0})
            for name, unit, data in [("Kraft", "N", force), ("Weg", "µm", weg)]
        ]
        writer.write_segment([RootObject({"operator": "M. Muster"}), GroupObject("Achse 2"), *channels])
with TdmsWriter("time.tdms") as writer:
    stamps = np.datetime64("2026-04-03T12:00:00") + (time * 1e6).astype("timedelta64[us]")
    writer.write_segment([
        ChannelObject("log", "Zeit", stamps, {"unit_string": "s"}),
        ChannelObject("log", "Kraft [N]", force.astype(np.float32)),
        ChannelObject("log", "Weg [µm]", weg),
    ])

# Universal file: FRF, type 4, response +y over force +y of two points.
frequency = np.arange(1.0, 40.01, 0.25)
omega, own = 2 * np.pi * frequency, 2 * np.pi * 10.0
frf = -omega**2 / (5.0 * (own**2 - omega**2 + 2j * 0.02 * own * omega))
file = pyuff.UFF("frf_type4.uff")
for direction in (1, 2, 3):
    file.write_sets({
        "type": 58, "binary": 0, "func_type": 4, "load_case_id": 0, "rsp_node": 1, "rsp_dir": direction,
        "ref_node": 1, "ref_dir": direction, "ord_data_type": 6, "abscissa_spacing": 1, "abscissa_min": frequency[0],
        "abscissa_inc": 0.25, "num_pts": len(frequency), "x": frequency, "data": frf / direction,
        "abscissa_spec_data_type": 18, "ordinate_spec_data_type": 12, "orddenom_spec_data_type": 13,
        "id1": "accelerance", "rsp_ent_name": "NONE", "ref_ent_name": "NONE",
    }, "overwrite" if direction == 1 else "add")
