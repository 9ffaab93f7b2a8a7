// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document.h"

#include <QByteArray>
#include <QCryptographicHash>

namespace episcope {

/// Tells documents with different pixels or labels apart, across programs.
inline QByteArray digest_of(const AnnotationDocument& document) {
  QCryptographicHash hash(QCryptographicHash::Sha1);
  for (const LabelInfo& label : document.labels().labels()) {
    hash.addData(QByteArray::number(label.id) + label.name.c_str());
    hash.addData(QByteArray(reinterpret_cast<const char*>(label.color.data()), 3));
  }
  const ScribbleLayer& layer = document.scribbles();
  for (const ViewIndex view : layer.painted_views()) {
    hash.addData(QByteArray::number(view.v) + ' ' + QByteArray::number(view.u));
    hash.addData(QByteArray(reinterpret_cast<const char*>(layer.view(view).data),
                            static_cast<qsizetype>(layer.height()) * layer.width()));
  }
  return hash.result().toHex();
}

}  // namespace episcope
