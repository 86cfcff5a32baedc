"""Feeds check_layers good and bad trees: a check that cannot fail is none."""
import tempfile
import unittest
from pathlib import Path

import check_layers


def faults_of(**files):
    """The faults of a tree that holds the given files; `__` in a name stands for `/`."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            stem, suffix = name.replace("__", "/").rsplit("_", 1)
            file = Path(folder) / f"{stem}.{suffix}"
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text + "\n", encoding="utf-8")
        return check_layers.faults(folder)[0]


class CheckLayersTest(unittest.TestCase):
    def test_empty(self):
        self.assertEqual(faults_of(src__base__x_cc="int x;"), [])

    def test_downward_include_is_fine(self):
        self.assertEqual(faults_of(src__scene__x_cc='#include "clearway/map/voxel_map.h"'), [])

    def test_own_private_header_is_fine(self):
        self.assertEqual(
            faults_of(src__map__x_cc='#include "map/y.h"', src__map__y_h="#pragma once"), [])

    def test_programs_see_every_layer(self):
        self.assertEqual(faults_of(examples__x_cc='#include "clearway/client/mirror.h"'), [])

    def test_refuses_upward_include_with_its_place(self):
        self.assertEqual(
            faults_of(include__clearway__map__x_h='\n#include "clearway/scene/frame.h"'),
            ["include/clearway/map/x.h:2: map lies below scene"])

    def test_refuses_upward_include_in_a_source(self):
        self.assertEqual(len(faults_of(src__base__x_cc='#include "clearway/geometry/pose.h"')), 1)

    def test_refuses_spaced_and_angled_includes(self):
        self.assertEqual(len(faults_of(src__base__x_cc="#  include <clearway/map/ray.h>")), 1)

    def test_refuses_private_header_of_another_layer(self):
        self.assertEqual(
            len(faults_of(src__scene__x_cc='#include "map/y.h"', src__map__y_h="")), 1)

    def test_converters_are_for_those_who_speak_the_wire_format(self):
        converter = {"src__wire__y_h": ""}
        self.assertEqual(faults_of(src__client__x_cc='#include "wire/y.h"', **converter), [])
        self.assertEqual(len(faults_of(examples__x_cc='#include "wire/y.h"', **converter)), 1)

    def test_refuses_private_header_in_a_public_one(self):
        self.assertEqual(
            len(faults_of(include__clearway__map__x_h='#include "map/y.h"', src__map__y_h="")), 1)

    def test_refuses_maps_in_planning(self):
        self.assertEqual(
            len(faults_of(include__clearway__planning__x_h='#include "clearway/map/ray.h"')), 1)

    def test_refuses_a_layer_that_does_not_exist(self):
        self.assertEqual(len(faults_of(src__utils__x_cc='#include "clearway/map/ray.h"')), 1)

    def test_third_party_in_its_place_is_fine(self):
        self.assertEqual(faults_of(src__collision__narrowphase_cc="#include <fcl/fcl.h>",
                                   src__planning__x_cc="#include <ompl/base/State.h>",
                                   src__io__x_cc="#include <octomap/octomap.h>"), [])

    def test_refuses_third_party_elsewhere(self):
        for include in ["fcl/fcl.h", "ompl/base/State.h", "octomap/OcTree.h", "grpcpp/grpcpp.h",
                        "google/protobuf/message.h", "clearway/v1/scene.pb.h", "cairo/cairo.h",
                        "sqlite3.h", "nlohmann/json.hpp"]:
            with self.subTest(include):
                self.assertEqual(len(faults_of(src__scene__x_cc=f"#include <{include}>")), 1)

    def test_refuses_fcl_and_protobuf_in_public_headers(self):
        self.assertEqual(
            len(faults_of(include__clearway__collision__x_h="#include <fcl/fcl.h>",
                          include__clearway__io__x_h='#include "clearway/v1/scene.pb.h"')), 2)


if __name__ == "__main__":
    unittest.main()
