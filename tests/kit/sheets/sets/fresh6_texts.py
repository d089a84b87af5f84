"""What the pages of the set "fresh6" say beside their values, in six languages."""

from __future__ import annotations

NOTE = {
    "en": "Materials and specifications are subject to change without notice. For standard equipment.",
    "de": "Technische Änderungen und Irrtümer vorbehalten. Angaben für Maschine mit Standardausrüstung.",
    "fr": "Caractéristiques données à titre indicatif, pour la machine en équipement standard.",
    "es": "Especificaciones sujetas a cambios sin previo aviso. Datos para la máquina con equipo estándar.",
    "zh": "本样本数据以标准配置为准，如有变更恕不另行通知。",
    "ja": "本仕様は標準仕様車の値です。改良のため予告なく変更することがあります。",
}
OPERATOR = {
    "en": "Operating weight includes full fuel tank and 80 kg operator.",
    "de": "Betriebsgewicht mit vollem Tank und Fahrer 80 kg.",
    "fr": "Poids avec plein de carburant et conducteur de 80 kg.",
    "es": "Peso con tanque lleno y operador de 80 kg.",
    "zh": "重量含满箱燃油及80 kg司机。",
    "ja": "質量には燃料満量とオペレータ80 kgを含む。",
}
TITLE = {"en": "Specifications", "de": "Technische Daten", "fr": "Caractéristiques techniques",
          "es": "Especificaciones", "zh": "技术参数", "ja": "主要諸元"}  # fmt: skip
MODEL = {"en": "Model", "de": "Modell", "fr": "Modèle", "es": "Modelo", "zh": "型号", "ja": "型式"}
SAID_IN = {"en": "Unit", "de": "Einheit", "fr": "Unité", "es": "Unidad", "zh": "单位", "ja": "単位"}
PROSE = {
    "engine": {
        "en": "Meets EU Stage V emission standards. Oil change interval 500 h.",
        "de": "Erfüllt die Abgasstufe V. Ölwechselintervall 500 h.",
        "fr": "Conforme à la norme Stage V. Vidange toutes les 500 h.",
        "es": "Cumple la norma de emisiones EU Stage V. Cambio de aceite cada 500 h.",
        "zh": "符合国四排放标准，换油周期500 h。",
        "ja": "オフロード法2014年基準適合。オイル交換間隔 500 h。",
    },
    "hydraulics": {
        "en": "Load-sensing system with variable displacement piston pumps; flow is shared on demand.",
        "de": "Load-Sensing-System mit Verstellpumpen; bedarfsgerechte Aufteilung der Ölmenge.",
        "fr": "Système à détection de charge avec pompes à cylindrée variable.",
        "es": "Sistema sensible a la carga con bombas de caudal variable.",
        "zh": "负荷传感系统，变量柱塞泵，按需供油。",
        "ja": "可変容量形ピストンポンプを用いたロードセンシングシステム。",
    },
    "travel": {
        "en": "Multi-disc brakes in oil bath, maintenance-free.",
        "de": "Wartungsfreie Lamellenbremsen im Ölbad.",
        "fr": "Freins multidisques à bain d'huile, sans entretien.",
        "es": "Frenos multidisco en baño de aceite, sin mantenimiento.",
        "zh": "湿式多片制动器，免维护。",
        "ja": "湿式多板ブレーキ採用、メンテナンスフリー。",
    },
}
