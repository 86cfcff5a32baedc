// The one test suite for every StateChecker: local, mirrored and remote.
//
// A user defines a default-constructible type with
//   std::shared_ptr<const StateChecker> Make(ScenePtr scene, Robot robot);
// and says INSTANTIATE_TYPED_TEST_SUITE_P(Name, CheckerSuite, ThatType). Whatever the checker needs
// (a server, a mirror) lives as long as the checker or that object. Nothing but the interface is
// assumed: errors are compared by code, statuses exactly, clearances to 1e-6 m.
#pragma once

#include "collision/checker_suite_batches.h"
#include "collision/checker_suite_motions.h"
#include "collision/checker_suite_objects.h"
#include "collision/checker_suite_space.h"

namespace clearway {

REGISTER_TYPED_TEST_SUITE_P(
    CheckerSuite, Empty, NamesVersionStampAndRobot, KnownFreeSpaceIsFree, StaticVoxelsOccupy,
    UnknownIsNotFreeUnlessAskedFor, OneUnknownVoxelBlocks, UnknownIsToleratedUpToItsShare,
    LinksThatShareVoxelsCountThemOnce, ARobotThinnerThanAVoxelIsJudgedByItsCenter,
    RegionsDeclaredFreeHideUnknownSpaceButNoObstacle, LeavingTheBoundsComesFirst,
    KeepOutBoxesOccupy, ObjectsAreWhereTheyWillBe, ObjectsAreWhereTheyWere,
    BeyondTheHorizonAllThatIsInReachBlocks, OccupiedComesBeforeBeyondHorizonBeforeUnknown,
    TheInsideOfAnObjectIsItsHullOrItsVoxelsAlone, GivenObjectsAreTheirShape,
    StatedFuturesAreFollowed, MotionsAreCheckedAgainstStatedFutures, PaddingGrowsTheRobot,
    InflationGrowsWithTheTimeSinceAnObjectWasPlaced, BoundsGrowWithTheTimeSinceAnObjectsLastPose,
    InflationMaySpareWhatIsKnownToRest, IgnoredObjectsAreNotThere, EveryIdOfAnObjectNamesIt,
    AllowedContactsHoldForTheirLinkAlone, TheLowestLinkThenObjectIsReported,
    ClearanceIsTheDistanceToWhatBlocks, ClearanceEndsWhereItWasAskedTo,
    EveryShapeReachesAsFarAsItShould, AClosedMeshIsSolid, PosesOfShapesInTheirLinkCount,
    AnswersComeInTheOrderOfTheStates, AnswersAreThoseOfTheLocalChecker,
    ManyThreadsGetTheSameAnswers, RefusesBatchesThatDoNotFit, RefusesOptionsOutOfRange,
    MotionsAreAnsweredAsByTheLocalChecker, MotionsAreProvedFreeOrShowTheirFirstContact,
    NoMotionsAreAValidQuestion, RefusesMotionsThatDoNotFit);

}  // namespace clearway
