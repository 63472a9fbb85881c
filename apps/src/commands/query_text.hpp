// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `query` says of what it found.
#pragma once

#include "completeness.hpp"
#include "hypermap/core/places/relations.hpp"
#include "hypermap/io/archive/map_query.hpp"
#include "past_text.hpp"

namespace hypermap::app {

/// Answers with what belongs to them. Refers to all of it.
struct ShownAnswers {
  const MapAnswers& answers;
  const CompletenessById& seen;  ///< Of answers that are objects.
  const MapArchive& archive;
  const RelationGraph& graph;  ///< Of the confirmed objects; empty when another layer was asked.
  bool complete = false;       ///< Guesses of boxes are shown.
  const ShownPast* past = nullptr;  ///< Null when it is asked for now.
  bool sentences = false;           ///< A sentence for each object is shown to people.
};

/// To standard output, one JSON document.
void print_json(const ShownAnswers& shown);

/// To standard output, for people: a table and how many it has.
void print_table(const ShownAnswers& shown);

}  // namespace hypermap::app
