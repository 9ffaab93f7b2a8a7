#!/usr/bin/python3
"""Writes the files beside it as other tools do: tifffile (napari, scikit-image), Pillow, h5py
(ilastik). Labels of 4 rows and 6 columns: column 1 has 1, column 3 has 2, column 4 has 5."""

import json
import pathlib

import h5py
import numpy as np
import tifffile
from PIL import Image

folder = pathlib.Path(__file__).parent
labels = np.zeros((4, 6), int)
labels[:, 1] = 1
labels[:, 3] = 2
labels[:, 4] = 5

tifffile.imwrite(folder / "u32.tif", labels.astype("u4"))
tifffile.imwrite(folder / "i64_zlib.tif", labels.astype("i8"), compression="zlib", software=False)
tifffile.imwrite(folder / "big_u64.tif", labels.astype("u8"), bigtiff=True)
tifffile.imwrite(folder / "be_u16.tif", labels.astype(">u2"), byteorder=">")
tifffile.imwrite(folder / "i8.tif", np.where(labels == 5, -1, labels).astype("i1"))
tifffile.imwrite(folder / "f32.tif", labels.astype("f4"))
pages = np.stack([labels] * 9)
pages[:, 0, 0] = range(1, 10)
tifffile.imwrite(folder / "pages.tif", pages.astype("i4"), metadata={"axes": "TYX"},
                 photometric="minisblack")

voc = Image.new("P", (6, 4))
voc.putdata(labels.astype("u1").ravel().tolist())
voc.putpalette([0, 0, 0, 128, 0, 0, 0, 128, 0, 1, 1, 1, 2, 2, 2, 128, 0, 128] + [0] * (3 * 250))
voc.save(folder / "palette.tif")
voc.save(folder / "palette.png")
Image.fromarray(labels == 1).save(folder / "onebit.png")
Image.fromarray(labels == 1).save(folder / "onebit.tif")
Image.fromarray(np.where(labels == 5, 40000, labels).astype("u2")).save(folder / "u16.png")
Image.fromarray(np.where(labels == 5, 255, labels).astype("u1")).save(folder / "ignore.png")

with h5py.File(folder / "ilastik.h5", "w") as file:
    data = file.create_dataset("exported_data", data=labels.astype("u4")[None, :, :, None])
    axes = [{"key": key, "typeFlags": 2, "resolution": 0, "description": ""} for key in "tyxc"]
    data.attrs["axistags"] = json.dumps({"axes": axes})
