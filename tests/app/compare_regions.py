#!/usr/bin/env python3
"""Compares two masks by plain numpy, all points with all.

compare_regions.py A B COLUMNS ROWS SLICES DX DY DZ: reads A and B (uint8, columns fastest), writes Dice, Jaccard, and the mean,
the 95th percentile and the largest of the distances between the middles of voxel faces on both surfaces, both ways, in mm.
"""
import math
import sys

import numpy

columns, rows, slices = (int(word) for word in sys.argv[3:6])
spacing = numpy.array([float(word) for word in sys.argv[6:9]])


def read(name):
    return numpy.fromfile(name, dtype=numpy.uint8).reshape(slices, rows, columns).transpose(2, 1, 0) != 0


def faces(mask):
    points = []
    for axis in range(3):
        behind = numpy.moveaxis(mask, axis, 0)
        places = numpy.argwhere(numpy.moveaxis(behind[1:] != behind[:-1], 0, axis)).astype(float)
        places[:, axis] += 0.5
        points.append(places * spacing)
    return numpy.concatenate(points)


def nearest(points, others):
    return [math.sqrt(((others - point) ** 2).sum(axis=1).min()) for point in points]


a, b = read(sys.argv[1]), read(sys.argv[2])
common = float((a & b).sum())
print(2 * common / (a.sum() + b.sum()), common / (a | b).sum())
surface_a, surface_b = faces(a), faces(b)
distances = sorted(nearest(surface_a, surface_b) + nearest(surface_b, surface_a))
print(sum(distances) / len(distances), distances[math.ceil(0.95 * len(distances)) - 1], distances[-1])
