#!/usr/bin/env python3
"""Draws a volume with one of VTK's ray casters. Commands come as lines of JSON, answers go as lines of JSON.

Usage: vtk_peer.py processor|opengl VOLUME.raw NX NY NZ SX SY SZ
VOLUME.raw: int16, x fastest. A command: {"values": [[value, opacity a mm, r, g, b]...], "gradients": [[a, opacity]...],
"side": pixels, "step": mm, "azimuth": degrees, "elevation": degrees, "half_height": mm, "file": "x.png"}."""
import json
import math
import sys
import time

import vtk
from vtk.util import numpy_support
import numpy


def main():
    size = [int(n) for n in sys.argv[3:6]]
    spacing = [float(s) for s in sys.argv[6:9]]
    voxels = numpy.fromfile(sys.argv[2], dtype=numpy.int16)
    image = vtk.vtkImageData()
    image.SetDimensions(size)
    image.SetSpacing(spacing)
    image.GetPointData().SetScalars(numpy_support.numpy_to_vtk(voxels, deep=False))

    if sys.argv[1] == "opengl":
        mapper = vtk.vtkOpenGLGPUVolumeRayCastMapper()
    else:
        mapper = vtk.vtkFixedPointVolumeRayCastMapper()
    mapper.SetInputData(image)
    mapper.SetAutoAdjustSampleDistances(0)
    mapper.SetImageSampleDistance(1.0)
    properties = vtk.vtkVolumeProperty()
    properties.ShadeOn()
    properties.SetAmbient(0.22)
    properties.SetDiffuse(0.78)
    properties.SetSpecular(0.25)
    properties.SetSpecularPower(40)
    properties.SetInterpolationTypeToLinear()
    properties.SetScalarOpacityUnitDistance(1.0)
    volume = vtk.vtkVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(properties)
    view = vtk.vtkRenderer()
    view.SetBackground(0.07, 0.08, 0.10)
    view.AddVolume(volume)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.AddRenderer(view)
    middle = [0.5 * (n - 1) * s for n, s in zip(size, spacing)]
    print(json.dumps({"version": vtk.vtkVersion().GetVTKVersion()}), flush=True)

    shown = None
    for line in sys.stdin:
        command = json.loads(line)
        functions = (command["values"], command["gradients"], command["step"])
        if functions != shown:
            colours = vtk.vtkColorTransferFunction()
            opacities = vtk.vtkPiecewiseFunction()
            for value, opacity, red, green, blue in command["values"]:
                colours.AddRGBPoint(value, red, green, blue)
                opacities.AddPoint(value, 1.0 - math.exp(-opacity))
            properties.SetColor(colours)
            properties.SetScalarOpacity(opacities)
            gradients = vtk.vtkPiecewiseFunction()
            for gradient, opacity in command["gradients"]:
                gradients.AddPoint(gradient, opacity)
            properties.SetGradientOpacity(gradients)
            properties.SetDisableGradientOpacity(0 if command["gradients"] else 1)
            mapper.SetSampleDistance(command["step"])
            shown = functions
        window.SetSize(command["side"], command["side"])
        camera = view.GetActiveCamera()
        camera.ParallelProjectionOn()
        a, e = math.radians(command["azimuth"]), math.radians(command["elevation"])
        into = [-math.sin(a) * math.cos(e), math.cos(a) * math.cos(e), -math.sin(e)]
        camera.SetFocalPoint(middle)
        camera.SetPosition([m - 2000.0 * d for m, d in zip(middle, into)])
        camera.SetViewUp(0.0, 0.0, 1.0)
        camera.SetParallelScale(command["half_height"])
        view.ResetCameraClippingRange()
        times = []
        for _ in range(3):
            view.GetActiveCamera().Modified()
            begin = time.perf_counter()
            window.Render()
            window.WaitForCompletion()
            times.append(time.perf_counter() - begin)
        if command["file"]:
            grab = vtk.vtkWindowToImageFilter()
            grab.SetInput(window)
            grab.ReadFrontBufferOff()
            writer = vtk.vtkPNGWriter()
            writer.SetInputConnection(grab.GetOutputPort())
            writer.SetFileName(command["file"])
            writer.Write()
        print(json.dumps({"seconds": min(times[1:]), "first": times[0]}), flush=True)


main()
