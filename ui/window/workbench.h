#pragma once

namespace arris::ui {

class ColourMapPanel;
class ComparisonPresenter;
class CorrectionsPresenter;
class ElementsPresenter;
class ExplanationPresenter;
class FieldPresenter;
class FilesPresenter;
class HistogramPanel;
class HistoryPresenter;
class MeshView;
class NamedViewsPresenter;
class PicturesPresenter;
class ReportPresenter;
class ResultsPresenter;
class SectionBar;
class SectionPresenter;
class Session;
class SideBySide;
class StabilityPresenter;
class StartPage;
class StatusPresenter;
class StepsPresenter;
class ThresholdPresenter;
class TourPresenter;
class TreatmentBar;
class TreatmentsPresenter;
class UnitPresenter;
class ViewMemory;
class ViewPresenter;
class WorklistPresenter;

/// The parts that the window is put together from; it owns them.
struct Workbench {
  Session* session = nullptr;

  StartPage* start_page = nullptr;
  SideBySide* side_by_side = nullptr;
  MeshView* view = nullptr;
  ColourMapPanel* colour_map = nullptr;
  HistogramPanel* histogram = nullptr;
  SectionBar* section_bar = nullptr;
  TreatmentBar* treatment_bar = nullptr;

  FieldPresenter* fields = nullptr;
  ElementsPresenter* elements = nullptr;
  SectionPresenter* section = nullptr;
  ComparisonPresenter* comparison = nullptr;
  ViewPresenter* surface = nullptr;
  TreatmentsPresenter* treatments = nullptr;
  ThresholdPresenter* thresholds = nullptr;
  StepsPresenter* steps = nullptr;
  UnitPresenter* units = nullptr;
  WorklistPresenter* worklist = nullptr;
  ExplanationPresenter* explanations = nullptr;
  CorrectionsPresenter* corrections = nullptr;
  StabilityPresenter* stability = nullptr;
  HistoryPresenter* history = nullptr;
  NamedViewsPresenter* named_views = nullptr;
  PicturesPresenter* pictures = nullptr;
  ReportPresenter* reports = nullptr;
  ResultsPresenter* results = nullptr;
  FilesPresenter* files = nullptr;
  StatusPresenter* status = nullptr;
  ViewMemory* view_memory = nullptr;
  TourPresenter* tour = nullptr;
};

}  // namespace arris::ui
