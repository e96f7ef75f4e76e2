#!/usr/bin/env python3
"""Checks a bill of materials of packaging/sbom.sh: sbom_check.py SPDX PACKAGES BUILD

It is SPDX 2.3 (tag-value): its fields, identifiers, relations, checksums. It names every package whose shared library
the packages' files are linked with (readelf), and every one whose headers or static libraries were compiled into them
(what ninja knows of the build folder BUILD), each with version and license. Prints what is missing; status 1 then."""
import hashlib
import os
import re
import subprocess
import sys
import tempfile

# Declarations alone: the kernel's, GL's types; and what only tests include.
WITHOUT_CODE = {"linux", "libglvnd", "googletest"}
LIBRARY_PARTS = r"CMakeFiles/reflet(_core|_gpu|_noise|_effects|_lighting|_exports)?\.dir/"
DOCUMENT = ["SPDXVersion", "DataLicense", "SPDXID", "DocumentName", "DocumentNamespace", "Creator", "Created"]
PACKAGE = ["PackageName", "SPDXID", "PackageVersion", "PackageDownloadLocation", "FilesAnalyzed",
           "PackageLicenseConcluded", "PackageLicenseDeclared", "PackageCopyrightText"]
FILE = ["FileName", "SPDXID", "FileChecksum", "LicenseConcluded", "LicenseInfoInFile", "FileCopyrightText"]
OPTIONAL = {"PackageFileName", "PackageVerificationCode", "PackageChecksum", "PackageLicenseInfoFromFiles",
            "Relationship"}
mistakes = []


def said(*command, **more):
    return subprocess.run(command, check=True, capture_output=True, text=True, **more).stdout


def expect(holds, mistake):
    if not holds:
        mistakes.append(mistake)


class Bill:
    def __init__(self, path):
        self.sections = [{}]  # the document, then packages and files: field -> values
        self.relations = []
        with open(path, encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                match = re.fullmatch(r"([A-Za-z]+): (\S.*)", line.rstrip("\n"))
                expect(match or line == "\n", f"line {number} is not TAG: VALUE")
                if match:
                    self.add(*match.groups())
        self.packages = {s["PackageName"][0]: s for s in self.sections if "PackageName" in s}
        self.ids = [s.get("SPDXID", [""])[0] for s in self.sections]

    def add(self, tag, value):
        if tag in ("PackageName", "FileName"):
            self.sections.append({})
        if tag == "Relationship":
            self.relations.append(value.split(" "))
        self.sections[-1].setdefault(tag, []).append(value)

    def related(self, package, relation):
        own = self.packages[package]["SPDXID"][0]
        names = {s["SPDXID"][0]: name for name, s in self.packages.items()}
        return {names[to] for start, kind, to in self.relations if start == own and kind == relation and to in names}


def check_form(bill):
    for section in bill.sections:
        fields = PACKAGE if "PackageName" in section else FILE if "FileName" in section else DOCUMENT
        name = section.get("PackageName", section.get("FileName", ["the document"]))[0]
        for field in fields:
            expect(field in section, f"{name} has no {field}")
        for field in section:
            expect(field in fields or field in OPTIONAL, f"{name} has a field {field}, which SPDX 2.3 does not know")
        if "PackageName" in section:
            expect(section.get("PackageLicenseDeclared") != ["NOASSERTION"], f"{name} has no license: packaging/licenses.txt")
            expect(section.get("PackageVersion") != ["NOASSERTION"], f"{name} has no version")
    document = bill.sections[0]
    expect(document.get("SPDXVersion") == ["SPDX-2.3"] and document.get("DataLicense") == ["CC0-1.0"], "it is not SPDX 2.3")
    expect(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", document.get("Created", [""])[0]), "Created is no time in UTC")
    for identifier in bill.ids:
        expect(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", identifier), f"'{identifier}' is no identifier")
        expect(bill.ids.count(identifier) == 1, f"{identifier} is there twice")
    for relation in bill.relations:
        expect(len(relation) == 3 and relation[0] in bill.ids and relation[2] in bill.ids,
               f"{' '.join(relation)}: of something that is not there")


class Installed:
    """What dpkg knows: the package of each file, and the source package of each package."""

    def __init__(self):
        self.package = {}
        for name in os.listdir("/var/lib/dpkg/info"):
            if name.endswith(".list"):
                with open(os.path.join("/var/lib/dpkg/info", name), encoding="utf-8") as file:
                    self.package.update(dict.fromkeys(file.read().split("\n"), name[:-len(".list")].split(":")[0]))
        self.source = dict(line.split(" ") for line in
                           said("dpkg-query", "-W", "-f", "${Package} ${source:Package}\n").splitlines())

    def package_of(self, file):
        real = os.path.realpath(file)
        for name in (real, file, real.removeprefix("/usr"), "/usr" + file):
            if name in self.package:
                return self.package[name]
        sys.exit(f"sbom_check.py: {file} is in no package")

    def sources(self, packages):
        """For a package that is not installed, its own name."""
        return {self.source.get(package, package) for package in packages}


def linked(file):
    """Paths of the shared libraries that a file names itself."""
    needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", said("readelf", "-dW", file)))
    paths = dict(re.findall(r"^\s*(\S+) => (/\S+)", said("ldd", file), re.MULTILINE))
    return {name: paths.get(name) for name in needed if not name.startswith("ld-")}


def check_files(bill, package, folder, installed):
    listed = {s["FileName"][0]: s for s in bill.sections if s.get("SPDXID", [""])[0].startswith(
        bill.packages[package]["SPDXID"][0] + "-") and "FileName" in s}
    there = {"./" + os.path.relpath(os.path.join(at, name), folder)
             for at, _, names in os.walk(folder) for name in names if not os.path.islink(os.path.join(at, name))}
    expect(there <= set(listed), f"{package}: not listed: {sorted(there - set(listed))[:5]}")
    depends = installed.sources(bill.related(package, "DEPENDS_ON"))
    for name in sorted(there & set(listed)):
        path = os.path.join(folder, name)
        with open(path, "rb") as file:
            content = file.read()
        expect(f"SHA256: {hashlib.sha256(content).hexdigest()}" in listed[name]["FileChecksum"], f"{name}: another checksum")
        if content.startswith(b"\x7fELF"):
            for library, found in linked(path).items():
                if library.startswith("libreflet."):
                    continue
                source = installed.source[installed.package_of(found)] if found else None
                expect(source in depends, f"{package} depends on no package of {library} ({source})")


def compiled(build, library, installed):
    """Packages whose headers and static libraries are in what was built, by source package."""
    files = set()
    wanted = False
    for line in said("ninja", "-C", build, "-t", "deps").split("\n"):
        if ": #deps" in line:
            wanted = re.match(LIBRARY_PARTS, line) is not None if library else line.startswith("CMakeFiles/")
        elif wanted and line.strip().startswith("/usr/"):
            files.add(line.strip())
    if not library:
        link = said("ninja", "-C", build, "-t", "commands", "-s", "bin/reflet")
        files |= set(re.findall(r"(/usr/\S+\.a)\b", link))
    owners = {installed.package_of(file) for file in files}
    return {installed.source[owner]: owner for owner in owners}


def main():
    spdx, packages, build = sys.argv[1:4]
    bill = Bill(spdx)
    check_form(bill)
    installed = Installed()
    for package in sorted(name for name in os.listdir(packages) if name.endswith(".deb")):
        path = os.path.join(packages, package)
        name = said("dpkg-deb", "-f", path, "Package").strip()
        expect(name in bill.packages, f"the package {name} is not there")
        if name not in bill.packages:
            continue
        with tempfile.TemporaryDirectory() as folder:
            said("dpkg-deb", "-x", path, folder)
            check_files(bill, name, folder, installed)
        if name == "reflet" or re.fullmatch(r"libreflet\d+", name):
            parts = compiled(build, name != "reflet", installed)
            covered = installed.sources(bill.related(name, "STATIC_LINK") | bill.related(name, "DEPENDS_ON"))
            expect(len(parts) > 4, f"{build} knows nothing of the headers of {name}")
            for source, owner in sorted(parts.items()):
                expect(source in covered or source in WITHOUT_CODE, f"{name}: code of {owner} is in it, and not named")
            for extra in sorted(installed.sources(bill.related(name, "STATIC_LINK")) - set(parts)):
                mistakes.append(f"{name}: nothing of {extra} is in it, but it is named")
    for mistake in mistakes:
        print(f"sbom_check.py: {mistake}", file=sys.stderr)
    sys.exit(1 if mistakes else 0)


main()
