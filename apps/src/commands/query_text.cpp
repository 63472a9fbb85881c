// SPDX-License-Identifier: BSD-3-Clause
#include "query_text.hpp"

#include "hypermap/core/objects/object_beliefs.hpp"
#include "hypermap/core/places/relation_text.hpp"
#include "hypermap/io/archive/object_relations.hpp"
#include "tables.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

/// Less probable classes are not in the text: two digits would say 0.00.
constexpr double kLeastInText = 0.005;

std::vector<double> numbers_of(const PlanPoint& point) {
  std::vector<double> numbers{point.xy.x(), point.xy.y()};
  if (point.z) numbers.push_back(*point.z);
  return numbers;
}

std::vector<double> numbers_of(const Eigen::Vector3d& size) {
  return {size.x(), size.y(), size.z()};
}

/// A class as the program tells it.
Json json_of(const ClassEvidence& c, const ClassRegistry& classes) {
  return {{"name", classes.name(c.id)}, {"probability", c.probability.value()}};
}

/// Adds what is believed of an object to its entry.
void add_beliefs(Json& entry, const ObjectBeliefs& beliefs, const ClassRegistry& classes) {
  const auto& all = beliefs.classes;
  entry["real_probability"] = beliefs.real.value();
  entry["class_entropy_nats"] =
      beliefs.class_entropy_nats ? Json(*beliefs.class_entropy_nats) : Json(nullptr);
  entry["runner_up"] = all.size() > 1 ? json_of(all[1], classes) : Json(nullptr);
  entry["classes"] = Json::array();
  for (const ClassEvidence& c : all) entry["classes"].push_back(json_of(c, classes));
}

/// Adds when it was seen; nothing to answers that are no objects of the 3D map.
void add_times(Json& entry, const MapAnswer& one, const ShownAnswers& shown) {
  if (!one.beliefs && shown.past == nullptr) return;
  const Object* object = shown.archive.objects.find(ObjectId{static_cast<std::uint32_t>(one.id)});
  if (object != nullptr) add_seen(entry, *object, shown.past);
}

/// Adds what was seen of an object; nothing to answers that are no objects.
void add_completeness(Json& entry, const MapAnswer& one, const ShownAnswers& shown) {
  const auto object = shown.seen.find(one.id);
  if (object == shown.seen.end()) return;
  entry["seen_share"] = object->second.seen_share;
  if (shown.complete) entry["completed_box"] = guess_json(object->second);
}

std::string sentence(const MapAnswer& one, const ShownAnswers& shown) {
  return sentence_of(shown.graph, ObjectId{static_cast<std::uint32_t>(one.id)}, [&](ObjectId id) {
    return called(shown.archive, id);
  });
}

/// Adds what an object is to others; nothing to answers that are no objects.
void add_relations(Json& entry, const MapAnswer& one, const ShownAnswers& shown) {
  const ObjectId id{static_cast<std::uint32_t>(one.id)};
  const auto support = support_of(shown.graph, id);
  if (!support) return;
  entry["support"] = name_of(support->kind);
  entry["relations"] = Json::array();
  for (const Relation& relation : relations_of(shown.graph, id)) {
    const ObjectId other = relation.subject == id ? relation.object : relation.subject;
    Json json{{"relation", key_of(relation.kind)}, {"id", other.value}};
    json["name"] = called(shown.archive, other);
    for (const auto& [name, value] : measures_of(relation.evidence))
      json[std::string(name)] = value;
    json["source"] = name_of(relation.evidence.source);
    entry["relations"].push_back(std::move(json));
  }
  entry["sentence"] = sentence(one, shown);
}

std::string joined(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + fixed(number, 3);
  return text;
}

std::string text_of(const ClassEvidence& c, const ClassRegistry& classes) {
  return printable(classes.name(c.id)) + " " + fixed(c.probability.value(), 2);
}

/// The second class; "-" when there is none, or none that two digits do not round to 0: that is the
/// lowest id of those that share what is left, and no runner-up.
std::string runner_up_text(const std::vector<ClassEvidence>& all, const ClassRegistry& classes) {
  const bool is_told = all.size() > 1 && all[1].probability.value() >= kLeastInText;
  return is_told ? text_of(all[1], classes) : "-";
}

/// The classes that two digits do not round to 0; "-" when there are none.
std::string text_of(const std::vector<ClassEvidence>& all, const ClassRegistry& classes) {
  std::string text;
  for (const ClassEvidence& c : all) {
    if (c.probability.value() < kLeastInText) break;  // the most probable come first
    text += (text.empty() ? "" : ", ") + text_of(c, classes);
  }
  return text.empty() ? "-" : text;
}

/// A table of answers: of objects, what was seen and believed of them follows what all have.
class AnswerTable {
 public:
  // One layer answers: its answers all have beliefs, or none has; likewise shares.
  explicit AnswerTable(const ShownAnswers& shown)
      : shown_(shown),
        has_beliefs_(!shown.answers.found.empty() && shown.answers.found.front().beliefs),
        has_similarity_(!shown.answers.found.empty() && shown.answers.found.front().similarity),
        has_distance_(!shown.answers.found.empty() && shown.answers.found.front().distance_m),
        table_(heading(), has_beliefs_ ? LastColumn::kText : LastColumn::kNumber) {}

  void add(const MapAnswer& one) {
    std::vector<std::string> row{printable(one.name),
                                 std::to_string(one.id),
                                 std::to_string(one.value),
                                 joined(numbers_of(one.position)),
                                 fixed(one.confidence, 2),
                                 one.size_m ? joined(numbers_of(*one.size_m)) : "-"};
    if (has_similarity_)
      row.insert(row.begin() + 2, one.similarity ? fixed(*one.similarity, 4) : "-");
    if (has_distance_) row.insert(row.begin() + 2, fixed(one.distance_m, 2));
    if (shown_.past != nullptr) {
      row.push_back(first_seen_text(*shown_.past, one.id));
      row.push_back(last_seen_text(*shown_.past, one.id));
    }
    add_completeness(row, one.id);
    if (has_beliefs_) add_beliefs(row, one);
    table_.add(std::move(row));
  }

  [[nodiscard]] std::string text() const { return table_.text(); }

 private:
  [[nodiscard]] std::vector<std::string> heading() const {
    std::vector<std::string> out{"name",
                                 "id",
                                 "value",
                                 "position (" + printable(shown_.answers.frame_id) + ")",
                                 "confidence",
                                 "size m"};
    if (has_similarity_) out.insert(out.begin() + 2, "similarity");
    if (has_distance_) out.insert(out.begin() + 2, "distance m");
    if (shown_.past != nullptr) out.insert(out.end(), {"first seen s", "last seen s"});
    if (!shown_.seen.empty()) out.emplace_back("seen");
    if (!shown_.seen.empty() && shown_.complete) out.emplace_back("completed size m (guess)");
    if (has_beliefs_) out.insert(out.end(), {"P(real)", "entropy nats", "runner-up", "classes"});
    return out;
  }

  void add_completeness(std::vector<std::string>& row, std::uint64_t id) const {
    if (shown_.seen.empty()) return;
    const auto found = shown_.seen.find(id);
    const Completeness* object = found == shown_.seen.end() ? nullptr : &found->second;
    row.push_back(object != nullptr ? fixed(object->seen_share, 2) : "-");
    if (!shown_.complete) return;
    const bool is_guessed = object != nullptr && object->completed;
    row.push_back(is_guessed ? joined(numbers_of(object->completed->extent())) : "-");
  }

  void add_beliefs(std::vector<std::string>& row, const MapAnswer& one) const {
    const auto& all = one.beliefs->classes;
    row.push_back(fixed(one.beliefs->real.value(), 2));
    row.push_back(fixed(one.beliefs->class_entropy_nats, 2));
    row.push_back(runner_up_text(all, shown_.archive.classes));
    row.push_back(text_of(all, shown_.archive.classes));
  }

  const ShownAnswers& shown_;
  bool has_beliefs_;
  bool has_similarity_;
  bool has_distance_;
  Table table_;
};

}  // namespace

void print_json(const ShownAnswers& shown) {
  Json json{{"frame", shown.answers.frame_id}, {"results", Json::array()}};
  for (const MapAnswer& one : shown.answers.found) {
    Json entry{{"id", one.id},
               {"name", one.name},
               {"value", one.value},
               {"position", numbers_of(one.position)},
               {"confidence", one.confidence ? Json(*one.confidence) : Json(nullptr)}};
    if (one.similarity) entry["similarity"] = *one.similarity;
    if (one.distance_m) entry["distance_m"] = *one.distance_m;
    if (one.size_m) entry["size_m"] = numbers_of(*one.size_m);
    if (one.beliefs) add_beliefs(entry, *one.beliefs, shown.archive.classes);
    add_times(entry, one, shown);
    add_completeness(entry, one, shown);
    add_relations(entry, one, shown);
    json["results"].push_back(std::move(entry));
  }
  if (shown.past != nullptr) add_past(json, *shown.past);
  std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

void print_table(const ShownAnswers& shown) {
  AnswerTable table(shown);
  for (const MapAnswer& one : shown.answers.found) table.add(one);
  std::printf("%s%zu found\n", table.text().c_str(), shown.answers.found.size());
  if (shown.past != nullptr) std::printf("%s", past_text(*shown.past).c_str());
  if (!shown.sentences) return;
  for (const MapAnswer& one : shown.answers.found) {
    std::printf("%s\n", printable(sentence(one, shown)).c_str());
  }
}

}  // namespace hypermap::app
