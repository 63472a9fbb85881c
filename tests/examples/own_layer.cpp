// SPDX-License-Identifier: BSD-3-Clause
// How do I add a layer of my own type? A temperature field: saved, loaded, asked, updated, drawn.
// Usage: own_layer OUTPUT.hmap OUTPUT.png
#include <hypermap/io/archive/map_archive.hpp>
#include <hypermap/io/archive/map_query.hpp>
#include <hypermap/io/codec/atomic_file.hpp>
#include <hypermap/io/codec/bounded_yaml.hpp>
#include <hypermap/io/codec/png_image.hpp>
#include <hypermap/viewer_offscreen/snapshot/layer_scene.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace hypermap;  // NOLINT(google-build-using-namespace): a program in one file

/// Degrees Celsius per cell. Its integer is the rounded temperature, its string cold, mild or warm.
class TemperatureField final : public MapLayer {
 public:
  GridGeometry geometry;
  std::vector<double> celsius;

  static Result<LayerContent> load(LayerReader& reader) {
    HYPERMAP_ASSIGN_OR_RETURN(const ValueTree tree, reader.yaml(".yaml"));
    const SourceName source;  // the archive names file and member
    const YamlNode root(tree, "", source);
    TemperatureField field;
    HYPERMAP_ASSIGN_OR_RETURN(const YamlNode resolution, root.at("resolution"));
    HYPERMAP_ASSIGN_OR_RETURN(field.geometry.resolution_m, resolution.as_double(1e-3, 1e3));
    HYPERMAP_ASSIGN_OR_RETURN(const YamlNode cols, root.at("cols"));
    HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t num_cols, cols.as_int(1, 10'000));
    HYPERMAP_ASSIGN_OR_RETURN(const YamlNode values, root.at("celsius"));
    HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, values.as_list());
    for (const YamlNode& item : items) {
      HYPERMAP_ASSIGN_OR_RETURN(const double value, item.as_double(-273.15, 1e4));
      field.celsius.push_back(value);
    }
    field.geometry.cols = static_cast<int>(num_cols);
    field.geometry.rows = static_cast<int>(field.celsius.size()) / field.geometry.cols;
    if (field.geometry.num_cells() != field.celsius.size())
      return tl::make_unexpected(values.error("is no whole number of rows"));
    return LayerContent(std::move(field));
  }

  [[nodiscard]] std::string_view class_name() const override { return "TemperatureField"; }

  Result<void> save(LayerWriter& writer) const override {
    std::vector<ValueTree> values;
    for (const double value : celsius) values.push_back(make_number(value));
    return writer.yaml(".yaml",
                       make_map({{"resolution", make_number(geometry.resolution_m)},
                                 {"cols", make_number(geometry.cols)},
                                 {"celsius", make_list(std::move(values))}}));
  }

  [[nodiscard]] LayerStatistics statistics() const override {
    LayerStatistics statistics{.num_values = celsius.size()};
    if (celsius.empty()) return statistics;
    const Rect rect = bounds(geometry);
    statistics.bounds.emplace(Eigen::Vector3d(rect.min.x(), rect.min.y(), 0.0),
                              Eigen::Vector3d(rect.max.x(), rect.max.y(), 0.0));
    return statistics;
  }

  [[nodiscard]] Result<std::vector<LayerAnswer>> query(const LayerQuery& query) const override {
    std::vector<bool> in_area(celsius.size(), !query.area);
    if (query.area) {
      for_each_covered_cell(
          geometry, *query.area, [&](Cell cell, double) { in_area[geometry.index(cell)] = true; });
    }
    std::vector<LayerAnswer> answers;
    for (std::size_t i = 0; i < celsius.size(); ++i) {
      const Cell cell{static_cast<int>(i) % geometry.cols, static_cast<int>(i) / geometry.cols};
      if (!in_area[i] || (query.at && cell_at(geometry, query.at->xy) != cell)) continue;
      LayerAnswer answer{.id = i,
                         .name = celsius[i] < 15   ? "cold"
                                 : celsius[i] < 23 ? "mild"
                                                   : "warm",
                         .value = std::lround(celsius[i]),
                         .position = centre(geometry, cell)};
      if (has_representation(answer, query)) answers.push_back(std::move(answer));
    }
    return answers;
  }

  [[nodiscard]] std::vector<LayerPrimitive> draw() const override {
    DrawnCells cells{.geometry = geometry, .colors = {}};
    for (const double value : celsius) {
      const auto red = static_cast<std::uint8_t>(std::clamp(10.0 * (value - 5.0), 0.0, 255.0));
      cells.colors.push_back({red, 80, static_cast<std::uint8_t>(255 - red)});
    }
    return {cells, DrawnText{.position = {0.5, 0.5}, .text = "temperature", .color = {}}};
  }

  [[nodiscard]] bool equals(const MapLayer& other) const override {
    return is_same_layer(*this, other);
  }
  friend bool operator==(const TemperatureField& a, const TemperatureField& b) {
    return a.geometry == b.geometry && a.celsius == b.celsius;
  }
};

/// A room that is warm at one end.
TemperatureField measured() {
  TemperatureField field;
  field.geometry = {.resolution_m = 0.5, .cols = 8, .rows = 6};
  for (std::size_t i = 0; i < field.geometry.num_cells(); ++i)
    field.celsius.push_back(12.0 + 2.0 * static_cast<double>(i % 8));
  return field;
}

Result<std::size_t> count(const MapArchive& map, const MapQuery& query) {
  HYPERMAP_ASSIGN_OR_RETURN(const MapAnswers answers, query_map(map, query));
  return answers.found.size();
}

Result<void> ask(const MapArchive& map) {
  HYPERMAP_ASSIGN_OR_RETURN(const MapAnswers at,
                            query_map(map, {.layer = "heat", .at = PlanPoint{{3.9, 0.1}}}));
  std::printf("%s, %lld degrees\n",
              at.found.at(0).name.c_str(),
              static_cast<long long>(at.found.at(0).value));
  HYPERMAP_ASSIGN_OR_RETURN(const Polygon area, make_polygon({{0, 0}, {2, 0}, {2, 1}, {0, 1}}));
  HYPERMAP_ASSIGN_OR_RETURN(const std::size_t all, count(map, {.layer = "heat", .area = area}));
  HYPERMAP_ASSIGN_OR_RETURN(const std::size_t cold,
                            count(map, {.layer = "heat", .text = "cold", .area = area}));
  HYPERMAP_ASSIGN_OR_RETURN(const std::size_t of_20, count(map, {.layer = "heat", .value = 20}));
  std::printf("%zu cells in the area, %zu of them cold; %zu of 20 degrees\n", all, cold, of_20);
  return {};
}

/// An image where there is EGL; else it says so.
Result<void> draw(const Layer& layer, const char* file) {
  std::printf("%zu primitives\n", layer.content->draw().size());
  const auto image = render_snapshot(with_layer({.title = "heat"}, layer, {}), {.view = TopView{}});
  if (!image) {
    std::printf("no image: %s\n", to_string(image.error()).c_str());
    return {};
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, encode_png(*image));
  return write_file_atomically(file, bytes);
}

Result<void> run(const char* archive_file, const char* image_file) {
  LayerRegistry types = archive_layer_types();
  HYPERMAP_TRY(types.add(TemperatureField(), TemperatureField::load));

  MapArchive map;
  HYPERMAP_TRY(map.hypermap.add_layer({.info = {.name = "heat"}, .content = TemperatureField()}));
  HYPERMAP_TRY(map.hypermap.update("heat", measured()));
  HYPERMAP_TRY(save_archive(map, archive_file, {.layers = types}));

  // A program that does not know the type keeps the layer as it is.
  HYPERMAP_ASSIGN_OR_RETURN(const auto stock, load_archive(archive_file));
  std::printf("unread: %zu layers\n", stock.value.hypermap.layers().size());
  HYPERMAP_TRY(save_archive(stock.value, archive_file));

  HYPERMAP_ASSIGN_OR_RETURN(const auto loaded, load_archive(archive_file, {}, types));
  std::printf("same after load: %s\n", loaded.value == map ? "yes" : "no");
  HYPERMAP_TRY(ask(loaded.value));
  return draw(loaded.value.hypermap.layers().front(), image_file);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 4;
  const auto done = run(argv[1], argv[2]);
  if (done) return 0;
  std::fprintf(stderr, "%s\n", to_string(done.error()).c_str());
  return 2;
}
