// Converters of scene.proto.
#pragma once

#include "absl/status/statusor.h"
#include "clearway/scene/scene_params.h"
#include "clearway/scene/scene_snapshot.h"
#include "clearway/v1/scene.pb.h"
#include "clearway/wire/answers.h"
#include "wire/geometry_wire.h"

namespace clearway {

void Write(const Versioned& scene, v1::SceneVersion* proto);
Versioned ReadVersion(const v1::SceneVersion& proto);
inline Versioned VersionOf(const SceneSnapshot& scene) { return {scene.version, scene.stamp}; }

void Write(const SceneQuery& query, v1::SceneSelector* proto);
SceneQuery ReadQuery(const v1::SceneSelector& proto);

v1::SpaceStatus ToProto(SpaceStatus status);
// A status that is missing or not known (of a newer server) is UNRESOLVED: not free.
SpaceStatus ReadSpaceStatus(int proto);

void Write(const SceneParams& params, v1::SceneParams* proto);
absl::StatusOr<SceneParams> ReadSceneParams(const std::string& field, const v1::SceneParams& proto);

}  // namespace clearway
