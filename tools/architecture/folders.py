"""Graphs of folders, made from graphs of files, and the circles in them."""

from pathlib import PurePosixPath


def levels(graph):
    """For each folder that has others inside, the graph of what lies in it: {folder: graph}.

    The names in such a graph are the folders directly inside, "a/b/", each with all that is in it, and the folder's own modules,
    a header and its source being one ("a/x" for "a/x.h" and "a/x.cpp"). "" is the project. Where no such graph has a circle, no
    two folders of any depth use each other, directly or by way of others.
    """
    found = {}
    for name, targets in graph.items():
        for target in targets:
            at = common_folder(name, target)
            here, there = part_of(name, at), part_of(target, at)
            if here != there:
                found.setdefault(at, {}).setdefault(here, set()).add(there)
    return found


def common_folder(first, second):
    """The deepest folder that holds both files."""
    shared = []
    for one, other in zip(PurePosixPath(first).parent.parts, PurePosixPath(second).parent.parts):
        if one != other:
            break
        shared.append(one)
    return "/".join(shared)


def part_of(name, folder):
    """The folder directly inside of folder that holds the file name, "a/b/"; the module "a/x" for a file of folder's own."""
    parts = PurePosixPath(name).with_suffix("").parts
    depth = len(PurePosixPath(folder).parts) + 1 if folder else 1
    return "/".join(parts[:depth]) + ("/" if len(parts) > depth else "")


def circles(graph):
    """The sets of names that reach each other and have a folder among them, as sorted lists."""
    names = sorted(set(graph) | {target for targets in graph.values() for target in targets})
    reach = {name: reachable(graph, name) for name in names}
    found = {tuple(sorted(n for n in reach[name] if name in reach[n])) for name in names if name in reach[name]}
    return sorted(list(circle) for circle in found if any(name.endswith("/") for name in circle))


def file_circles(graph):
    """The sets of files that reach each other, as sorted lists."""
    reach = {name: reachable(graph, name) for name in graph}
    found = {tuple(sorted(n for n in reach[name] if name in reach[n])) for name in graph if name in reach[name]}
    return sorted(list(circle) for circle in found)


def reachable(graph, start):
    """All names that can be reached from start in one step or more."""
    seen, ahead = set(), list(graph.get(start, ()))
    while ahead:
        name = ahead.pop()
        if name not in seen:
            seen.add(name)
            ahead += graph.get(name, ())
    return seen


def between(graph, folder, names):
    """Uses of one of the names by another at the level of folder: [(file, file it uses)], in order."""
    chosen = []
    for name, targets in graph.items():
        for target in targets:
            if common_folder(name, target) == folder:
                ends = part_of(name, folder), part_of(target, folder)
                if ends[0] != ends[1] and set(ends) <= set(names):
                    chosen.append((name, target))
    return sorted(chosen)
