#!/usr/bin/env python3
"""sbom.py FOLDER ORIGINS --version V [--headers PACKAGE...]: what is in FOLDER, as SPDX 2.3 and as CycloneDX 1.5.

ORIGINS has a line for each file of others: its path in FOLDER, a tab, and the file of this system that it was copied from.
The system's dpkg knows the package of that file. Packages whose headers alone are part of the programs are named by
--headers. Writes FOLDER/share/doc/sbom/tidemark.spdx.json and tidemark.cdx.json; dates are SOURCE_DATE_EPOCH's.

A package's licence is its copyright file, whole: Debian's files name the licences of all sources, those of parts that are
not in the library too, so that an expression made from them by rule would be wrong. Their names stand beside it.
"""
import argparse
import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import uuid

HOME = "https://example.org/tidemark"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("origins", type=pathlib.Path)
    parser.add_argument("--version", required=True)
    parser.add_argument("--headers", nargs="*", default=[])
    return parser.parse_args()


def command(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


def owners(files):
    """The package of each file. Debian's list may know a file by its path before /bin, /lib became links."""
    found = {}
    asked = sorted(set(files) | {file.removeprefix("/usr") for file in files})
    answer = subprocess.run(["dpkg-query", "-S", *asked], capture_output=True, text=True).stdout
    for line in answer.splitlines():
        package, _, path = line.partition(": ")
        found[path] = package.split(",")[0].split(":")[0]
    result = {file: found.get(file) or found.get(file.removeprefix("/usr")) for file in files}
    for file, package in result.items():
        if package is None:
            raise SystemExit(f"sbom: no package owns {file}")
    return result


def facts(package):
    fields = ["Package", "Version", "Architecture", "source:Package", "source:Version", "Maintainer", "Homepage"]
    answer = command("dpkg-query", "-W", "-f", "\t".join("${%s}" % field for field in fields) + "\n", package)
    return dict(zip(fields, answer.splitlines()[0].split("\t")))


def licence_names(text):
    """The names of the licences in a copyright file of the machine-readable form, and none of any other form."""
    if not re.match(r"Format(-Specification)?:", text):
        return []
    return sorted(set(re.findall(r"^License: *(\S.*)$", text, re.M)))


def digests(path):
    content = path.read_bytes()
    return {"SHA1": hashlib.sha1(content).hexdigest(), "SHA256": hashlib.sha256(content).hexdigest()}


def identifier(*words):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.]+", "-", "-".join(words))


def purl(fact):
    version = fact["Version"].replace(":", "%3A").replace("+", "%2B").replace("~", "~")
    return f"pkg:deb/debian/{fact['Package']}@{version}?arch={fact['Architecture']}"


def snapshot(fact):
    return f"https://snapshot.debian.org/package/{fact['source:Package']}/{fact['source:Version']}/"


def spdx(bundle, version, when):
    files, packages, relations, texts = [], [], [], []
    for path, sums in bundle["files"].items():
        files.append({
            "SPDXID": identifier("File", hashlib.sha1(path.encode()).hexdigest()),
            "fileName": "./" + path,
            "checksums": [{"algorithm": name, "checksumValue": value} for name, value in sums.items()],
            "licenseConcluded": "NOASSERTION", "licenseInfoInFiles": ["NOASSERTION"], "copyrightText": "NOASSERTION"})

    def package(ref, fields, paths):
        entry = {"SPDXID": ref, "filesAnalyzed": bool(paths), "licenseConcluded": "NOASSERTION",
                 "copyrightText": "NOASSERTION", **fields}
        if paths:
            sums = "".join(sorted(bundle["files"][path]["SHA1"] for path in paths))
            entry["packageVerificationCode"] = {
                "packageVerificationCodeValue": hashlib.sha1(sums.encode()).hexdigest()}
            entry["licenseInfoFromFiles"] = ["NOASSERTION"]
        packages.append(entry)
        for path in paths:
            relations.append({"spdxElementId": ref, "relationshipType": "CONTAINS", "relatedSpdxElement":
                              identifier("File", hashlib.sha1(path.encode()).hexdigest())})

    own = identifier("Package", "tidemark")
    package(own, {"name": "tidemark", "versionInfo": version, "downloadLocation": "NOASSERTION",
                  "licenseDeclared": "Apache-2.0", "primaryPackagePurpose": "APPLICATION"}, bundle["own"])
    relations.append({"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": own})
    for name, part in bundle["packages"].items():
        ref, fact = identifier("Package", name), part["facts"]
        licence = "LicenseRef-Debian-" + re.sub(r"[^A-Za-z0-9.-]+", "-", name)
        package(ref, {
            "name": name, "versionInfo": fact["Version"], "downloadLocation": snapshot(fact),
            "supplier": "Organization: Debian", "licenseDeclared": licence,
            "licenseComments": "Debian's copyright file names: " + ("; ".join(part["licences"]) or "see its text"),
            "sourceInfo": f"built from {fact['source:Package']} {fact['source:Version']}",
            "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                              "referenceLocator": purl(fact)}]}, part["files"])
        texts.append({"licenseId": licence, "name": f"{name}'s terms", "extractedText": part["copyright"]})
        relations.append({"spdxElementId": own, "relatedSpdxElement": ref,
                          "relationshipType": "CONTAINS" if part["files"] else "STATIC_LINK"})
    return {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"tidemark-{version}", "documentNamespace": f"{HOME}/spdx/{bundle['uuid']}",
        "creationInfo": {"created": when, "creators": ["Tool: tidemark-sbom.py", "Organization: Tidemark developers"]},
        "packages": packages, "files": files, "hasExtractedLicensingInfos": texts, "relationships": relations}


def cyclonedx(bundle, version, when):
    def file_component(path):
        return {"type": "file", "name": path, "hashes": [
            {"alg": name.replace("SHA", "SHA-"), "content": value} for name, value in bundle["files"][path].items()]}

    components = []
    for name, part in bundle["packages"].items():
        fact = part["facts"]
        components.append({
            "type": "library", "bom-ref": purl(fact), "name": name, "version": fact["Version"], "purl": purl(fact),
            "licenses": [{"license": {"name": "; ".join(part["licences"]) or "see its text", "text": {
                "contentType": "text/plain", "content": part["copyright"]}}}],
            "externalReferences": [{"type": "distribution", "url": snapshot(fact)}],
            "components": [file_component(path) for path in part["files"]]})
    return {
        "bomFormat": "CycloneDX", "specVersion": "1.5", "serialNumber": f"urn:uuid:{bundle['uuid']}", "version": 1,
        "metadata": {"timestamp": when, "component": {
            "type": "application", "bom-ref": "tidemark", "name": "tidemark", "version": version,
            "licenses": [{"license": {"id": "Apache-2.0"}}],
            "components": [file_component(path) for path in bundle["own"]]}},
        "components": components,
        "dependencies": [{"ref": "tidemark", "dependsOn": [part["bom-ref"] for part in components]}]}


def read_bundle(folder, origins, headers):
    paths = sorted(str(path.relative_to(folder)) for path in folder.rglob("*")
                   if path.is_file() and not path.is_symlink())
    paths = [path for path in paths if not path.startswith("share/doc/sbom/")]
    sources = dict(line.split("\t") for line in origins.read_text().splitlines())
    for path in sources:
        if path not in paths:
            raise SystemExit(f"sbom: {path} is in {origins}, but not in {folder}")
    owner = owners(set(sources.values()))
    packages = {}
    for name in sorted(set(owner.values()) | set(headers)):
        text = pathlib.Path(f"/usr/share/doc/{name}/copyright").read_text(errors="replace")
        packages[name] = {"facts": facts(name), "copyright": text, "licences": licence_names(text),
                          "files": [path for path in paths if path in sources and owner[sources[path]] == name]}
    files = {path: digests(folder / path) for path in paths}
    return {"files": files, "own": [path for path in paths if path not in sources], "packages": packages,
            "uuid": uuid.uuid5(uuid.NAMESPACE_URL, HOME + json.dumps(files, sort_keys=True))}


def main():
    options = arguments()
    bundle = read_bundle(options.folder, options.origins, options.headers)
    epoch = int(os.environ.get("SOURCE_DATE_EPOCH", "0"))
    when = datetime.datetime.fromtimestamp(epoch, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    out = options.folder / "share/doc/sbom"
    out.mkdir(parents=True, exist_ok=True)
    for name, make in (("tidemark.spdx.json", spdx), ("tidemark.cdx.json", cyclonedx)):
        (out / name).write_text(json.dumps(make(bundle, options.version, when), indent=1, sort_keys=True) + "\n")
    print(f"{len(bundle['files'])} files, {len(bundle['packages'])} packages of Debian: {out}")


if __name__ == "__main__":
    main()
