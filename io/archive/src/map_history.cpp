// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_history.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/map_sessions.hpp"
#include "hypermap/io/codec/time_text.hpp"
#include "hypermap/projection/layers/object_footprints.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

const SemanticLayer* semantic_shapes_of(const MapArchive& archive) {
  return archive.hypermap.find_as<SemanticLayer>(kSemanticLayer);
}

/// The map with these objects alone, and what belongs to all of them.
MapArchive with_objects(const MapArchive& archive, ObjectMap objects) {
  MapArchive past;
  past.classes = archive.classes;
  past.detectors = archive.detectors;
  past.vocabulary = archive.vocabulary;
  past.provenance = archive.provenance;
  past.extension_entries = archive.extension_entries;
  past.hypermap.frames() = archive.hypermap.frames();
  past.floor = archive.floor;
  past.objects = std::move(objects);
  return past;
}

/// Gives the map the layer `semantic`, in the frame that it has in the whole map.
Result<void> put_shapes(MapArchive& past,
                        const MapArchive& archive,
                        std::vector<SemanticObject> shapes) {
  HYPERMAP_ASSIGN_OR_RETURN(SemanticLayer layer, SemanticLayer::create(std::move(shapes)));
  const Layer* now = archive.hypermap.find(kSemanticLayer);
  LayerInfo info = now == nullptr ? LayerInfo{.name = std::string(kSemanticLayer)} : now->info;
  return past.hypermap.add_layer({.info = std::move(info), .content = std::move(layer)});
}

/// The objects and the layer `semantic` of them: names and confidences by the objects, outlines
/// those of now where the map shows them now.
Result<MapArchive> with_projected(const MapArchive& archive,
                                  ObjectMap objects,
                                  std::span<const ObjectId> confirmed,
                                  const ConfirmationOptions& rules) {
  std::vector<const Object*> chosen;
  chosen.reserve(confirmed.size());
  for (const ObjectId id : confirmed) chosen.push_back(&objects.at(id));
  HYPERMAP_ASSIGN_OR_RETURN(
      const FootprintLayer footprints,
      project_footprints(chosen, archive.classes, {.confidence = rules.confidence}));
  const auto projected = footprints.layer.objects();
  std::vector<SemanticObject> shapes(projected.begin(), projected.end());
  const SemanticLayer* now = semantic_shapes_of(archive);
  for (SemanticObject& shape : shapes) {
    const SemanticObject* shown = now == nullptr ? nullptr : now->find(shape.id);
    if (shown != nullptr) shape.parts = shown->parts;
  }
  MapArchive past = with_objects(archive, std::move(objects));
  HYPERMAP_TRY(put_shapes(past, archive, std::move(shapes)));
  return past;
}

/// The objects of those ids alone. Requires: `ids` ascend.
ObjectMap only_these(const ObjectMap& objects, std::span<const ObjectId> ids) {
  ObjectMap chosen = objects;
  for (const Object& object : objects.objects()) {
    if (!std::ranges::binary_search(ids, object.id)) chosen.erase(object.id);
  }
  return chosen;
}

/// Which objects the rules confirmed then, and of which that cannot be told. Both ascend.
struct PastConfirmation {
  std::vector<ObjectId> confirmed;
  std::vector<ObjectId> unknown;
};

/// Those of which nothing is known stand as they are now: what they alone keep from being confirmed
/// is unknown too.
PastConfirmation confirmation_of(const ObjectMap& now,
                                 const PastObjects& past,
                                 const ConfirmationOptions& rules) {
  ObjectMap all = now;
  for (const Object& object : now.objects()) {
    if (const Object* then = past.objects.find(object.id)) {
      all.replace(*then);
    } else if (!past.unknown.contains(object.id)) {
      all.erase(object.id);
    }
  }
  PastConfirmation out;
  for (const ConfirmationResult& result : confirmation_results(all, rules)) {
    const bool is_hidden_by_unknown = result.missed.size() == 1 &&
                                      result.missed.front().condition == Condition::kOwnPlace &&
                                      past.unknown.contains(result.missed.front().stronger);
    if (is_hidden_by_unknown || past.unknown.contains(result.id)) {
      out.unknown.push_back(result.id);
    } else if (result.missed.empty()) {
      out.confirmed.push_back(result.id);
    }
  }
  return out;
}

Unexpected frames_unknown(const MapSession& session) {
  return fail(ErrorCode::kUnsupported,
              "the map does not tell which frames are of session " + name_of(session) +
                  ": an older version made it",
              "session");
}

Result<FrameRange> frames_of_session(const MapArchive& archive, const std::string& name) {
  HYPERMAP_ASSIGN_OR_RETURN(const MapSession session, find_session(archive.provenance, name));
  if (!session.frames) return frames_unknown(session);
  return *session.frames;
}

/// Frames within which stamps ascend, as far as the map tells: of one session, else of each.
Result<std::vector<FrameRange>> asked_frames(const MapArchive& archive,
                                             const std::optional<std::string>& name) {
  if (name) {
    HYPERMAP_ASSIGN_OR_RETURN(const FrameRange frames, frames_of_session(archive, *name));
    return std::vector{frames};
  }
  const std::vector<MapSession> sessions = sessions_of(archive.provenance);
  if (follow_each_other(sessions)) return std::vector{FrameRange{}};
  std::vector<FrameRange> all;
  all.reserve(sessions.size());
  for (const MapSession& session : sessions) {
    if (!session.frames) return frames_unknown(session);
    all.push_back(*session.frames);
  }
  return all;
}

Result<void> check_objects(const MapArchive& archive) {
  if (!archive.objects.empty()) return {};
  return fail(ErrorCode::kUnsupported,
              "the map has no objects of a 3D map, which alone are kept through time",
              "objects");
}

Result<MapMoment> moment_of(const MapArchive& archive,
                            Stamp stamp,
                            const std::optional<std::string>& session) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<FrameRange> frames, asked_frames(archive, session));
  if (frames.size() == 1) return MapMoment{.stamp = stamp, .frames = frames.front()};
  return fail(ErrorCode::kInvalidArgument,
              "is needed, as the sessions of the map do not follow each other in time: " +
                  to_string(sessions_of(archive.provenance)),
              "session");
}

/// Of the first span in which that is known it was seen in that, else unknown if it may have been.
Sighting was_seen_in_any(const Object& object, std::span<const ObservationSpan> spans) {
  Sighting seen = Sighting::kNotSeen;
  for (const ObservationSpan& span : spans) {
    const Sighting one = was_seen_in(object, span);
    if (one == Sighting::kSeen) return one;
    if (one == Sighting::kUnknown) seen = one;
  }
  return seen;
}

/// The objects of those ids, as they are now, and their shapes, if the map has any.
Result<MapArchive> seen_part_of(const MapArchive& archive, std::span<const ObjectId> ids) {
  MapArchive part = with_objects(archive, only_these(archive.objects, ids));
  const SemanticLayer* now = semantic_shapes_of(archive);
  if (now == nullptr) return part;
  std::vector<SemanticObject> shapes;
  for (const ObjectId id : ids) {
    if (const SemanticObject* shape = now->find(id.value)) shapes.push_back(*shape);
  }
  HYPERMAP_TRY(put_shapes(part, archive, std::move(shapes)));
  return part;
}

}  // namespace

Result<PastMap> map_as_of(const MapArchive& archive,
                          Stamp stamp,
                          const std::optional<std::string>& session,
                          const ConfirmationOptions& rules) {
  return guarded(ErrorCode::kInvalidArgument, "the past", [&]() -> Result<PastMap> {
    HYPERMAP_TRY(check_objects(archive));
    HYPERMAP_ASSIGN_OR_RETURN(const MapMoment moment, moment_of(archive, stamp, session));
    const PastObjects past = objects_as_of(archive.objects, moment);
    PastMap then;
    then.has_classes_of_now = rules.confidence.rule != ConfidenceRule::kRealAndClass ||
                              std::ranges::any_of(past.objects.objects(), [](const Object& object) {
                                return object.belief.options().tempering == ClassTempering::kNone;
                              });
    const PastConfirmation of_then = confirmation_of(archive.objects, past, rules);
    ObjectMap objects = past.objects;
    for (const ObjectId id : of_then.unknown) objects.erase(id);
    HYPERMAP_ASSIGN_OR_RETURN(
        then.map, with_projected(archive, std::move(objects), of_then.confirmed, rules));
    HYPERMAP_ASSIGN_OR_RETURN(
        then.unknown,
        with_projected(
            archive, only_these(archive.objects, of_then.unknown), of_then.unknown, rules));
    return then;
  });
}

Result<PastMap> map_seen_in(const MapArchive& archive, const AskedSpan& asked) {
  return guarded(ErrorCode::kInvalidArgument, "the span", [&]() -> Result<PastMap> {
    if (asked.since && asked.until && *asked.until < *asked.since) {
      return fail(ErrorCode::kInvalidArgument,
                  "must not be after the end at " + seconds_text(*asked.until) + " s, is " +
                      seconds_text(*asked.since) + " s",
                  "since");
    }
    HYPERMAP_TRY(check_objects(archive));
    HYPERMAP_ASSIGN_OR_RETURN(const auto frames, asked_frames(archive, asked.session));
    std::vector<ObservationSpan> spans;
    spans.reserve(frames.size());
    for (const FrameRange& range : frames)
      spans.push_back({.since = asked.since, .until = asked.until, .frames = range});
    const std::vector<ObjectId> confirmed = confirmed_ids_of(archive);
    std::vector<ObjectId> seen;
    std::vector<ObjectId> unknown;
    PastMap past;
    for (const Object& object : archive.objects.objects()) {
      const Sighting sighting = was_seen_in_any(object, spans);
      const bool is_confirmed = std::ranges::binary_search(confirmed, object.id);
      if (sighting == Sighting::kSeen && !is_confirmed) ++past.num_unconfirmed;
      if (sighting == Sighting::kSeen && is_confirmed) seen.push_back(object.id);
      if (sighting == Sighting::kUnknown && is_confirmed) unknown.push_back(object.id);
    }
    HYPERMAP_ASSIGN_OR_RETURN(past.map, seen_part_of(archive, seen));
    HYPERMAP_ASSIGN_OR_RETURN(past.unknown, seen_part_of(archive, unknown));
    return past;
  });
}

std::optional<MapTimes> times_of(const MapArchive& archive) {
  std::optional<MapTimes> times;
  const auto include = [&times](Stamp first, Stamp last) {
    if (!times) times = MapTimes{.first = first, .last = last};
    times->first = std::min(times->first, first);
    times->last = std::max(times->last, last);
  };
  for (const MapSession& session : sessions_of(archive.provenance)) {
    if (session.first && session.last) include(*session.first, *session.last);
  }
  if (times) return times;
  for (const Object& object : archive.objects.objects()) {
    include(object.first_seen, object.last_seen);
  }
  return times;
}

}  // namespace hypermap
