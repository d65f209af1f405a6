"""A server with models on a free port of this machine, which finds what is as bright as the clicks: PROTOCOL [FOLDER]

PROTOCOL: monai-label, dls (with v2/), dls-old (without). Writes its port on a line. Requests are kept in FOLDER, numbered.
It speaks as the public sources of MONAI Label (monailabel/endpoints) and of itksnap-dls (server.py) say.
"""
import array
import base64
import gzip
import http.server
import itertools
import json
import pathlib
import re
import struct
import sys
import urllib.parse
import uuid

TOLERANCE = 0.2  # of the range of values
NUMBERS = itertools.count()  # of the requests kept, which come at the same time, too
DTYPES = {2: "B", 4: "h", 8: "i", 16: "f", 64: "d", 512: "H"}
UINT8, FLOAT32 = (2, 8, "B"), (16, 32, "f")


def like(values, seeds, rejected):
    """A byte a voxel: 1 where the value is near one of the seeds' and near none of the rejected ones'."""
    span = TOLERANCE * (max(values) - min(values))
    near = lambda value, others: any(abs(value - values[other]) <= span for other in others)
    known = {value: int(near(value, seeds) and not near(value, rejected)) for value in set(values)}
    return [known[value] for value in values]


class Nifti:
    """A file that is not packed, with voxels in the order i, j, k."""

    def __init__(self, data):
        self.header = bytearray(data[:352])
        self.size = struct.unpack_from("<3h", data, 42)
        offset = int(struct.unpack_from("<f", data, 108)[0])
        self.voxels = array.array(DTYPES[struct.unpack_from("<h", data, 70)[0]], data[offset:])

    def offset(self, voxel):
        return voxel[0] + self.size[0] * (voxel[1] + self.size[1] * voxel[2])

    def turn(self):
        """The same place in the patient, with i from the other end."""
        for row in range(3):
            at = 280 + 16 * row
            step, *_, first = struct.unpack_from("<4f", self.header, at)
            struct.pack_into("<f", self.header, at, -step)
            struct.pack_into("<f", self.header, at + 12, first + (self.size[0] - 1) * step)
        struct.pack_into("<hh", self.header, 252, 0, 1)  # by the affine matrix alone

    def bytes_of(self, values, kind, turned):
        code, bits, letter = kind
        struct.pack_into("<hh", self.header, 70, code, bits)
        struct.pack_into("<3f", self.header, 108, 352, 1, 0)
        if turned:
            self.turn()
            row = self.size[0]
            values = [value for at in range(0, len(values), row) for value in reversed(values[at:at + row])]
        return gzip.compress(bytes(self.header) + array.array(letter, values).tobytes(), 1)


class MonaiLabel(http.server.BaseHTTPRequestHandler):
    MODELS = {
        "segmentation_ball": {"type": "segmentation", "labels": {"background": 0, "ball": 2}, "dimension": 3,
                              "description": "What is bright", "config": {}},
        "deepgrow_3d": {"type": "deepgrow", "labels": [], "dimension": 3, "description": "", "config": {}},
        "deepedit": {"type": "deepedit", "labels": ["left", "right"], "dimension": 3, "description": "", "config": {}},
        "soft": {"type": "deepgrow", "labels": None, "dimension": 3, "description": "Probabilities", "config": {}},
        "turned": {"type": "deepgrow", "labels": [], "dimension": 3, "description": "", "config": {}},
        "flat": {"type": "deepgrow", "labels": [], "dimension": 2, "description": "", "config": {}},
        "brush": {"type": "scribbles", "labels": [], "dimension": 3, "description": "", "config": {}},
    }

    def do_GET(self):
        if self.path != "/info/":
            return say(self, 404, {"detail": "Not Found"})
        say(self, 200, {"name": "Test", "labels": [], "models": self.MODELS, "trainers": {}, "datastore": {}})

    def do_POST(self):
        form = form_of(self)
        url = urllib.parse.urlsplit(self.path)
        model = urllib.parse.unquote(url.path.removeprefix("/infer/"))
        if model not in self.MODELS or url.query != "output=image":
            return say(self, 500, {"detail": f"Inference Task is not Initialized. There is no model '{model}' available"})
        params = json.loads(form["params"])
        image = Nifti(form["file"])
        kind, number = UINT8, 1
        if model == "segmentation_ball":
            seeds, rejected, number = [image.voxels.index(max(image.voxels))], [], 2
        elif model == "deepedit":
            number = self.MODELS[model]["labels"].index(params["label"]) + 1
            seeds, rejected = params[params["label"]], params["background"]
        else:
            seeds, rejected = params["foreground"], params["background"]
        offsets = lambda clicks: [image.offset(click) if isinstance(click, list) else click for click in clicks]
        values = [number * value for value in like(image.voxels, offsets(seeds), offsets(rejected))]
        if model == "soft":
            kind, values = FLOAT32, [0.9 if value else 0.25 for value in values]
        say_bytes(self, 200, "application/octet-stream", image.bytes_of(values, kind, model == "turned"))


class Dls(http.server.BaseHTTPRequestHandler):
    PREFIX = "/v2"
    MODELS = [{"id": "nnInteractive", "channels": [1], "dimensions": 3, "interactions": ["point", "box", "scribble", "lasso"]},
              {"id": "SAM2", "channels": [1, 3], "dimensions": 2, "interactions": ["point"]}]
    sessions = {}

    def do_GET(self):
        url = urllib.parse.urlsplit(self.path)
        query = urllib.parse.parse_qs(url.query)
        keep(self, b"")
        if url.path == "/status":
            return say(self, 200, {"status": "ok", "version": "0.1.4"})
        if url.path == "/sessions":  # of tests alone
            return say(self, 200, {"sessions": len(self.sessions)})
        if url.path == "/v2/models" and self.PREFIX:
            return say(self, 200, {"models": self.MODELS})
        if url.path == ("/v2/start_session/nnInteractive" if self.PREFIX else "/start_session"):
            session = str(uuid.uuid4())
            self.sessions[session] = {"inside": [], "outside": []}
            return say(self, 200, {"session_id": session})
        found = re.fullmatch(self.PREFIX + r"/(process_point_interaction|end_session)/([\w-]+)", url.path)
        if not found:
            return say(self, 404, {"detail": "Not Found"})
        state = self.sessions.get(found[2])
        if found[1] == "end_session":
            self.sessions.pop(found[2], None)
            return say(self, 200, {"message": "Session ended" if state else "Invalid session"})
        if state is None:
            return say(self, 200, {"error": "Invalid session"})
        i, j, k = [int(n) for n in query["point"]] if self.PREFIX else [int(query[axis][0]) for axis in "xyz"]
        size = state["dimensions"]
        side = "inside" if query["foreground"] == ["true"] else "outside"
        state[side].append(i + size[0] * (j + size[1] * k))
        mask = bytes(like(state["voxels"], state["inside"], state["outside"]))
        say(self, 200, {"status": "success", "result": base64.b64encode(gzip.compress(mask, 1)).decode()})

    def do_POST(self):
        form = form_of(self)
        state = self.sessions.get(self.path.rsplit("/", 1)[1])
        if self.path.rsplit("/", 1)[0] != self.PREFIX + "/upload_raw" or state is None:
            return say(self, 404, {"detail": "Not Found"})
        state["dimensions"] = json.loads(form["metadata"])["dimensions"]
        state["voxels"] = array.array("f", gzip.decompress(form["file"]))
        i, j, k = state["dimensions"]
        if len(state["voxels"]) != i * j * k:
            return say(self, 500, {"detail": "cannot reshape"})
        say(self, 200, {"message": "NIFTI file uploaded and stored in GPU memory"})


class OldDls(Dls):
    PREFIX = ""


def form_of(request):
    """The parts of a form by their names, as bytes."""
    body = request.rfile.read(int(request.headers["Content-Length"]))
    keep(request, body)
    boundary = b"--" + request.headers.get_param("boundary").encode()
    parts = {}
    for part in body.split(boundary)[1:-1]:
        head, _, content = part.partition(b"\r\n\r\n")
        parts[re.search(rb' name="(\w+)"', head)[1].decode()] = content[:-2]
    return parts


def keep(request, body):
    if len(sys.argv) > 2:
        folder = pathlib.Path(sys.argv[2])
        (folder / f"{next(NUMBERS):03}").write_bytes(f"{request.requestline}\n{request.headers}\n".encode() + body)


def say(request, status, answer):
    say_bytes(request, status, "application/json", json.dumps(answer).encode())


def say_bytes(request, status, kind, body):
    request.send_response(status)
    request.send_header("Content-Type", kind)
    request.send_header("Content-Length", str(len(body)))
    request.end_headers()
    request.wfile.write(body)


handler = {"monai-label": MonaiLabel, "dls": Dls, "dls-old": OldDls}[sys.argv[1]]
handler.protocol_version = "HTTP/1.1"
handler.log_message = lambda *_: None
with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
    print(server.server_address[1], flush=True)
    server.serve_forever()
