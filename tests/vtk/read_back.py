"""read_back.py <folder>: does VTK read what expected.txt says, bit for bit?"""
import pathlib
import struct
import sys
import xml.etree.ElementTree

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

KINDS = {
    "float32": ("I", 4, "vtkFloatArray"),
    "float64": ("Q", 8, "vtkDoubleArray"),
    "int32": ("I", 4, "vtkIntArray"),
    "int64": ("Q", 8, ("vtkLongArray", "vtkLongLongArray", "vtkTypeInt64Array")),
}
UNITS = {"velocity": "m/s", "stress": "Pa", "temperature": "K"}
SYMMETRIC = ["XX", "YY", "ZZ", "XY", "YZ", "XZ"]

folder = pathlib.Path(sys.argv[1])
wrong = 0
looked = 0


def check(holds, what):
    global wrong, looked
    looked += 1
    if not holds:
        wrong += 1
        print("WRONG:", what)


def read(name):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / name))
    reader.Update()
    check(reader.GetErrorCode() == 0, f"{name} is read without an error")
    return reader.GetOutput()


expected = {}
for line in (folder / "expected.txt").read_text().splitlines():
    file, name, kind, components, *words = line.split()
    expected.setdefault(file, []).append((name, kind, int(components), words))
check(len(expected) == 4, "there are four files")

for file, arrays in expected.items():
    data = read(file)
    count = len(arrays[0][3]) // arrays[0][2]
    check(data.GetNumberOfPoints() == count, f"{file} has {count} points")
    check(data.GetNumberOfVerts() == count, f"{file} has a vertex for each point")
    for k in (0, count - 1) if count else ():
        check(data.GetCell(k).GetNumberOfPoints() == 1 and data.GetCell(k).GetPointId(0) == k,
              f"{file}: vertex {k} is point {k}")
    if count:
        named = {data.GetPointData().GetArrayName(k) for k in range(data.GetPointData().GetNumberOfArrays())}
        check(named == {name for name, *_ in arrays} - {"Points"}, f"{file} has the arrays {named}")
    for name, kind, components, words in arrays:
        array = data.GetPoints().GetData() if name == "Points" else data.GetPointData().GetArray(name)
        what = f"{file}: {name}"
        if count == 0:
            check(array is None or array.GetNumberOfTuples() == 0, f"{what} is empty")
            continue
        letter, size, classes = KINDS[kind]
        check(array.GetClassName() in classes, f"{what} is {kind}, not {array.GetClassName()}")
        check(array.GetNumberOfComponents() == components, f"{what} has {components} components")
        bits = memoryview(array).tobytes()
        check(len(bits) == size * len(words), f"{what} has {len(words)} numbers")
        check(list(struct.unpack(f"={len(bits) // size}{letter}", bits)) == [int(w, 16) for w in words],
              f"{what} is the same, bit for bit")
        if name in UNITS:
            check(array.GetInformation().Get(array.UNITS_LABEL()) == UNITS[name], f"{what} has its unit")
        if name == "stress":
            check([array.GetComponentName(c) for c in range(6)] == SYMMETRIC, f"{what} names its components")
    listed = xml.etree.ElementTree.parse(folder / (file.split("_")[0] + ".pvd")).getroot().iter("DataSet")
    entries = [(float(e.get("timestep")), e.get("file")) for e in listed]
    check(entries[-1][1] == file, f"{file} is the last of its series")
    for time, name in entries:
        check(read(name).GetFieldData().GetArray("TimeValue").GetValue(0) == time, f"{name} knows its time")

print(f"{looked} things looked at, {wrong} wrong")
sys.exit(1 if wrong else 0)
