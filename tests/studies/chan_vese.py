#!/usr/bin/env python3
"""Segments a slice with scikit-image's Chan-Vese.

chan_vese.py FOLDER COLUMNS ROWS MU: reads FOLDER/image and FOLDER/phi (float32, rows one after the other), writes
FOLDER/mask (uint8, 1 where the level set is above 0 in the end).
"""
import sys

import numpy
from skimage.segmentation import chan_vese

folder, columns, rows, mu = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), float(sys.argv[4])


def read(name):
    return numpy.fromfile(f"{folder}/{name}", dtype=numpy.float32).reshape(rows, columns).astype(float)


mask = chan_vese(read("image"), mu=mu, tol=1e-5, max_num_iter=5000, dt=0.5, init_level_set=read("phi"))
mask.astype(numpy.uint8).tofile(f"{folder}/mask")
