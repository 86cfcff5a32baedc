"""Requests that are legal and large, as stubs made from proto/ know them."""
import math
import random
import struct
import sys

MS = 1_000_000


class Stubs:
    """The generated modules, from the folder that protoc wrote them to."""

    def __init__(self, folder):
        sys.path.insert(0, folder)
        from clearway.v1 import (check_service_pb2, frame_pb2, geometry_pb2, ingest_service_pb2,
                                 map_service_pb2, object_service_pb2, occupancy_service_pb2,
                                 robot_pb2)
        self.check, self.frame, self.geometry = check_service_pb2, frame_pb2, geometry_pb2
        self.ingest, self.map, self.object = ingest_service_pb2, map_service_pb2, object_service_pb2
        self.occupancy, self.robot = occupancy_service_pb2, robot_pb2

    def pose(self, x=0.0, y=0.0, z=0.0):
        return self.geometry.Pose(rotation=self.geometry.Quaternion(w=1),
                                  translation_m=self.geometry.Vector3(x=x, y=y, z=z))

    def push(self, sequence, stamp_ms, points=2000, range_m=30.0, x=0.0, sensor="sensor", seed=0):
        """A frame of points all around."""
        dice = random.Random(seed)
        frame = self.frame.Frame(sensor_id=sensor, sequence=sequence, stamp_ns=stamp_ms * MS)
        frame.world_from_sensor.CopyFrom(self.pose(x=x, z=1.0))
        for _ in range(points):
            angle, distance = dice.uniform(-math.pi, math.pi), dice.uniform(3, range_m)
            frame.points_m.extend((distance * math.cos(angle), distance * math.sin(angle),
                                   dice.uniform(-1, 2)))
        frame.labels.extend([0] * points)
        return self.ingest.PushFrameRequest(frame=frame)

    def long_rays(self, rays, range_m):
        frame = self.frame.Frame(sensor_id="evil", sequence=1, stamp_ns=10_000 * MS)
        frame.world_from_sensor.CopyFrom(self.pose())
        for i in range(rays):
            angle = 2 * math.pi * i / rays
            frame.points_m.extend((range_m * math.cos(angle), range_m * math.sin(angle), 0.0))
        frame.labels.extend([0] * rays)
        return self.ingest.PushFrameRequest(frame=frame)

    def ball(self, name="ball", radius_m=0.3):
        shape = self.robot.LinkShape(sphere=self.robot.Sphere(radius_m=radius_m),
                                     link_from_shape=self.pose())
        robot = self.robot.Robot(name=name, links=[self.robot.Link(name="body", shapes=[shape])])
        return self.check.RegisterRobotRequest(robot=robot)

    def states(self, robot_id, count, seed=1):
        """Each with its clearance and unknown share."""
        dice = random.Random(seed)
        places = [v for _ in range(count)
                  for v in (dice.uniform(-20, 20), dice.uniform(-20, 20), 1.0)]
        options = self.check.CheckOptions(unknown_space=2, clearance_up_to_m=10.0,
                                          with_unknown_fraction=True)
        poses = self.geometry.PoseArray(rotations_xyzw=[0, 0, 0, 1] * count, translations_m=places)
        return self.check.CheckStatesRequest(robot_id=robot_id, times_ns=[1000 * MS] * count,
                                             world_from_link=poses, options=options)

    def points(self, count):
        return self.occupancy.GetPointOccupancyRequest(points_m=[1.0] * (3 * count),
                                                       times_ns=[1000 * MS])

    def box_of_cells(self, half_m=19.9, height_m=2.4):
        low = self.geometry.Vector3(x=-half_m, y=-half_m, z=0)
        high = self.geometry.Vector3(x=half_m, y=half_m, z=height_m)
        return self.occupancy.GetBoxOccupancyRequest(
            box_world=self.geometry.AxisAlignedBox(min_m=low, max_m=high), times_ns=[1000 * MS],
            include_cells=True)

    def rays(self, count, range_m):
        dice = random.Random(2)
        return self.occupancy.CastRaysRequest(
            origins_m=[0.0, 0.0, 1.0] * count,
            directions=[dice.uniform(-1, 1) for _ in range(3 * count)],
            times_ns=[1000 * MS], max_range_m=range_m)

    def poses(self, objects, times):
        return self.object.PredictPosesRequest(object_ids=[1000] * objects,
                                               times_ns=[(1000 + t) * MS for t in range(times)])

    def one_object(self):
        size = self.geometry.Vector3(x=2, y=2, z=2)
        given = self.object.GivenObject(
            object_id=1000, shape=self.robot.ConvexShape(box=self.robot.Box(size_m=size)),
            world_from_object=self.pose(5, 5, 1), stamp_ns=1000 * MS)
        return self.object.AddObjectsRequest(objects=[given])


def mutate(octets, dice):
    """Some bytes changed, left out, doubled, or put in front of others."""
    octets = bytearray(octets)
    for _ in range(dice.choice((1, 1, 2, 4, 16))):
        if not octets:
            return bytes(octets)
        at = dice.randrange(len(octets))
        kind = dice.randrange(6)
        if kind == 0:
            octets[at] ^= 1 << dice.randrange(8)
        elif kind == 1:
            octets[at] = dice.choice((0, 1, 127, 128, 255))
        elif kind == 2:
            del octets[at:at + dice.choice((1, 4, 64))]
        elif kind == 3:
            octets[at:at] = octets[at:at + dice.choice((1, 8, 256))]
        elif kind == 4:
            number = dice.choice((0.0, -0.0, math.inf, -math.inf, math.nan, 1e300, -1e300, 1e-310))
            octets[at:at + 8] = struct.pack("<d", number)
        else:
            octets[at:at + 4] = struct.pack("<f", dice.choice((math.nan, math.inf, 3e38, 1e-40)))
    return bytes(octets)
