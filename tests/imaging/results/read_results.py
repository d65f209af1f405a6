"""Reads a result with pydicom, as another program would, and prints what it finds as JSON.

read_results.py FILE SOURCE_FOLDER
"""
import json
import pathlib
import sys

import numpy
import pydicom
from pydicom.sr._concepts_dict import concepts


def images_of(folder):
    """The source's images by their SOP Instance UID."""
    files = sorted(pathlib.Path(folder).glob("*.dcm"))
    images = [pydicom.dcmread(file, stop_before_pixels=True) for file in files]
    return {image.SOPInstanceUID: image for image in images}


def is_known(code):
    """Whether the standard's own tables have the code."""
    return any(code.CodeValue in values for values in concepts[code.CodingSchemeDesignator].values())


def rgb(lab):
    """PS3.3 C.10.7.1.1 and the formulas of CIE, written down independently of the writer."""
    l, a, b = lab[0] * 100 / 65535, lab[1] * 255 / 65535 - 128, lab[2] * 255 / 65535 - 128
    fy = (l + 16) / 116
    cube = lambda f: f**3 if f > 6 / 29 else 3 * (6 / 29) ** 2 * (f - 4 / 29)
    x, y, z = 0.950456 * cube(fy + a / 500), cube(fy), 1.088754 * cube(fy - b / 200)
    linear = numpy.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]]) @ [x, y, z]
    gamma = [12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055 for v in linear]
    return [int(round(255 * min(max(v, 0.0), 1.0))) for v in gamma]


def common(result, images):
    any_image = next(iter(images.values()), None)
    same = lambda name: any_image is None or getattr(any_image, name, None) == getattr(result, name, None)
    return {
        "same_patient": same("PatientID") and same("PatientName"),
        "same_study": same("StudyInstanceUID"),
        "same_frame_of_reference": same("FrameOfReferenceUID"),
        "own_series": any_image is None or any_image.SeriesInstanceUID != result.SeriesInstanceUID,
        "patient": str(result.PatientName),
    }


def segmentation(result, images):
    shared = result.SharedFunctionalGroupsSequence[0]
    orientation = numpy.array(shared.PlaneOrientationSequence[0].ImageOrientationPatient, float)
    between_rows, between_columns = shared.PixelMeasuresSequence[0].PixelSpacing
    pixels = result.pixel_array.reshape(-1, result.Rows, result.Columns)
    segments = [
        {
            "name": segment.SegmentLabel,
            "type": segment.SegmentedPropertyTypeCodeSequence[0].CodeMeaning,
            "known": is_known(segment.SegmentedPropertyTypeCodeSequence[0])
            and is_known(segment.SegmentedPropertyCategoryCodeSequence[0]),
            "colour": rgb(segment.RecommendedDisplayCIELabValue),
            "voxels": [],
        }
        for segment in result.SegmentSequence
    ]
    at_their_images = True
    for frame, group in zip(pixels, result.PerFrameFunctionalGroupsSequence):
        corner = numpy.array(group.PlanePositionSequence[0].ImagePositionPatient, float)
        number = group.SegmentIdentificationSequence[0].ReferencedSegmentNumber
        for row, column in zip(*numpy.nonzero(frame)):
            place = corner + orientation[:3] * column * between_columns + orientation[3:] * row * between_rows
            segments[number - 1]["voxels"].append(place.tolist())
        if images:
            source = group.DerivationImageSequence[0].SourceImageSequence[0]
            image = images[source.ReferencedSOPInstanceUID]
            off = numpy.abs(numpy.array(image.ImagePositionPatient, float) - corner).max()
            at_their_images &= bool(off < 1e-6) and source.ReferencedSOPClassUID == image.SOPClassUID
    return {"segments": segments, "frames": int(result.NumberOfFrames), "at_their_images": at_their_images}


def area(points):
    """Of a plane polygon in space, by the cross products of its corners."""
    following = numpy.roll(points, -1, axis=0)
    return numpy.linalg.norm(numpy.cross(points, following).sum(axis=0)) / 2


def structure_set(result, images):
    names = {region.ROINumber: region.ROIName for region in result.StructureSetROISequence}
    regions = []
    at_their_images = True
    for region in result.ROIContourSequence:
        contours = []
        for contour in region.get("ContourSequence", []):
            points = numpy.array(contour.ContourData, float).reshape(-1, 3)
            assert len(points) == contour.NumberOfContourPoints
            contours.append({"type": contour.ContourGeometricType, "area": area(points - points[0])})
            if images:
                image = images[contour.ContourImageSequence[0].ReferencedSOPInstanceUID]
                orientation = numpy.array(image.ImageOrientationPatient, float)
                normal = numpy.cross(orientation[:3], orientation[3:])
                off = (points - numpy.array(image.ImagePositionPatient, float)) @ normal
                at_their_images &= bool(numpy.abs(off).max() < 1e-3)
        regions.append(
            {
                "name": names[region.ReferencedROINumber],
                "colour": [int(value) for value in region.ROIDisplayColor],
                "contours": contours,
            }
        )
    return {"regions": regions, "at_their_images": at_their_images}


def items(container, relationship=None):
    found = container.get("ContentSequence", [])
    return [item for item in found if relationship is None or item.RelationshipType == relationship]


def meaning(item):
    return item.ConceptNameCodeSequence[0].CodeMeaning


def measure(item):
    value = item.MeasuredValueSequence[0]
    modifiers = [child.ConceptCodeSequence[0] for child in items(item, "HAS CONCEPT MOD")]
    codes = [item.ConceptNameCodeSequence[0], value.MeasurementUnitsCodeSequence[0], *modifiers]
    return {
        "quantity": meaning(item),
        "value": float(value.NumericValue),
        "unit": value.MeasurementUnitsCodeSequence[0].CodeValue,
        "derivation": modifiers[0].CodeMeaning if modifiers else "",
        "known": all(is_known(code) for code in codes if code.CodingSchemeDesignator != "IBSI"),
    }


def report(result, images):
    """The measurement groups of a report by TID 1500."""
    measured = next(item for item in items(result) if meaning(item) == "Imaging Measurements")
    groups = []
    for group in items(measured):
        by_name = {meaning(item): item for item in items(group) if item.ValueType != "NUM"}
        reference = next(item for item in items(group) if item.ValueType == "IMAGE").ReferencedSOPSequence[0]
        groups.append(
            {
                "name": by_name["Tracking Identifier"].TextValue,
                "finding": by_name["Finding"].ConceptCodeSequence[0].CodeMeaning,
                "segment": int(reference.ReferencedSegmentNumber),
                "instance": reference.ReferencedSOPInstanceUID,
                "measures": [measure(item) for item in items(group) if item.ValueType == "NUM"],
            }
        )
    return {
        "title": meaning(result),
        "template": result.ContentTemplateSequence[0].TemplateIdentifier,
        "source_series": by_name["Source series for segmentation"].UID in {image.SeriesInstanceUID for image in images.values()},
        "groups": groups,
    }


def selection(result, images):
    """What a key object selection names."""
    named = [item.ReferencedSOPSequence[0] for item in items(result) if item.ValueType == "IMAGE"]
    states = [one.ReferencedSOPSequence[0].ReferencedSOPInstanceUID for one in named if "ReferencedSOPSequence" in one]
    return {
        "title": meaning(result),
        "note": next(item.TextValue for item in items(result) if item.ValueType == "TEXT"),
        "known": all(one.ReferencedSOPInstanceUID in images for one in named),
        "images": len(named),
        "states": states,
    }


def presentation(result, images):
    """What a presentation state shows, with outlines in mm of the patient."""
    outlines, names, graphics = [], [], []
    for annotation in result.GraphicAnnotationSequence:
        image = images[annotation.ReferencedImageSequence[0].ReferencedSOPInstanceUID]
        corner = numpy.array(image.ImagePositionPatient, float)
        orientation = numpy.array(image.ImageOrientationPatient, float)
        rows, columns = image.PixelSpacing
        for line in annotation.GraphicObjectSequence:
            graphics += line.GraphicData
            # The middle of the first pixel is at 0.5\0.5 (PS3.3 Table C.10-5).
            pixels = numpy.array(line.GraphicData, float).reshape(-1, 2) - 0.5
            mm = corner + pixels[:, :1] * columns * orientation[:3] + pixels[:, 1:] * rows * orientation[3:]
            outlines.append(mm.tolist())
        for text in annotation.get("TextObjectSequence", []):
            names.append(text.UnformattedTextValue)
            graphics += text.AnchorPoint
    values = result.SoftcopyVOILUTSequence[0]
    area = result.DisplayedAreaSelectionSequence[0]
    return {
        "instance": result.SOPInstanceUID,
        "window": [float(values.WindowCenter), float(values.WindowWidth)],
        "area": [*area.DisplayedAreaTopLeftHandCorner, *area.DisplayedAreaBottomRightHandCorner],
        "same_rescaling": all(
            getattr(image, name) == getattr(result, name)
            for image in images.values()
            for name in ("RescaleSlope", "RescaleIntercept", "RescaleType")
        ),
        "layers": len(result.GraphicLayerSequence),
        "outlines": outlines,
        "columns": [min(graphics[::2]), max(graphics[::2])],
        "rows": [min(graphics[1::2]), max(graphics[1::2])],
        "names": names,
    }


def main():
    result = pydicom.dcmread(sys.argv[1])
    images = images_of(sys.argv[2])
    read = {"SEG": segmentation, "SR": report, "KO": selection, "PR": presentation}.get(result.Modality, structure_set)
    found = read(result, images)
    json.dump(common(result, images) | found, sys.stdout)


main()
