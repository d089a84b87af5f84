"""German wordings of makers' sheets, by type and name: what each is taken for; a value in front of a colon after a
minus is of something that no name asks for."""

from __future__ import annotations

import pytest
from specs_lexicon import misread

LABELS = """\
@wheel_loader
Lift Cylinder Stroke: Kolbenhub Hubzylinder
Tilt Cylinder Stroke: Schaufelkippzylinder Hub
Steering Cylinder Stroke: Knicklenkzylinder Hub
Lift Cylinder Bore: Zylinderbohrung Hubzylinder
Tilt Cylinder Bore: Durchmesser Kippzylinder
Steering Cylinder Bore: Zylinderdurchmesser Lenkzylinder
Lift Cylinder Rod Diameter: Hubzylinder Kolbenstangen-Ø
Steering Cylinder Rod Diameter: Kolbenstangen-Ø Lenkzylinder
Tilt Cylinder Rod Diameter: Kolbenstangen-Ø Kippzylinder
Lift Cylinder Closed Length: Hubzylinder geschlossene Länge
Main Relief Pressure: Öffnungsdruck Hauptdruckbegrenzungsventil
Steering Relief Pressure: Lenkung, max. Betriebsdruck
Main Pump Flow: Förderleistung Arbeitshydraulikpumpe
Steering Pump Flow: Lenkhydraulik Fördermenge
Raise Time: Hubzeit (mit Nutzlast)
Dump Time: Auskippen (beladen)
Lower Time: Absenken, leer, Schwimmstellung
Total Cycle Time: Hydraulikzykluszeit gesamt
Operating Weight: Betriebsgewicht (mit Standardschaufel)
Bucket Weight: Schaufelgewicht ca.
Counterweight Weight: Gewicht Kontergewicht
Static Tipping Load Straight: Statische Kipplast gestreckt mit Reifeneindrückung
Static Tipping Load Full Turn: Statische Kipplast bei vollem Lenkeinschlag (ISO 14397-1)
Breakout Force: Grabkraft Schaufelzylinder
Rimpull: Max. Zugkraft an den Rädern
Maximum Travel Speed: bauartbedingte Höchstgeschwindigkeit
Maximum Steering Angle: Maximaler Lenkeinschlag je Seite
Steering Angle: Knickwinkel links/rechts
Rear Axle Oscillation: Pendelausschlag Hinterachse
Rear Axle Oscillation Each Way: Hinterachse Pendelwinkel je Seite
Wheelbase: Radstand (Mitte Vorderachse bis Mitte Hinterachse)
Tread: Spurweite Standardreifen
Hinge Pin Height at Maximum Lift: Höhe bis Mitte Schaufelbolzen bei maximalem Hub
Hinge Pin Height at Carry: Höhe Schaufeldrehpunkt in Transportstellung
Rack Back at Ground: Schaufel Rückkippwinkel am Boden
Rack Back at Carry: Schaufelrückkippung in Transportstellung
Rack Back at Maximum Lift: Rückkippwinkel bei maximaler Hubhöhe
Dump Angle at Maximum Lift: Auskippwinkel in oberster Stellung
Dumping Clearance: Ausschütthöhe bei max. Hubhöhe und 45° Auskippwinkel
Dumping Reach: Reichweite bei max. Hubhöhe und 45° Auskippwinkel
Lift Arm Clearance at Maximum Lift: Freiraum unter dem Hubgerüst bei max. Hub
Digging Depth: Schürftiefe bei waagerechter Schaufel
Overall Length: Gesamtlänge (mit Schaufel am Boden)
Overall Length Without Bucket: Länge Grundmaschine ohne Schaufel
Overall Height: Höhe bis Oberkante Kabinendach
Overall Operating Height: Max. Gesamthöhe mit hochgestellter Schaufel
Overall Width: Fahrzeugbreite über Reifen
Bucket Width: Breite Standard-Erdschaufel
Ground Clearance: Bodenfreiheit unter Knickgelenk
Hitch Height: Höhe Mitte Anhängekupplung
Height to Top of Stack: Höhe bis Oberkante Auspuffrohr
Axle Height: Achsmitte über Boden
Rear Overhang: Abstand Mitte Hinterachse bis Hinterkante Kontergewicht
Rear Axle to Hitch: Hinterachsmitte bis Drehpunkt Knickgelenk
Turning Radius: Wenderadius über Außenkante Reifen
Bucket Capacity Heaped: Schaufelinhalt nach ISO 7546
Bucket Capacity Struck: Schaufelinhalt, gestrichen voll
Tyre Diameter: Außendurchmesser Reifen
Tyre Width: Reifenquerschnittsbreite
Net Power: Nettoleistung (ISO 9249/SAE J1349)
Gross Power: Motorleistung max. (ISO 14396)
Engine Power: Motorleistung bei 2200 1/min
-105 mm: Bohrung; Bohrung x Hub Motor; Zylinderbohrung Motor; Motorbohrung
-135 mm: Hub [Motor]; Kolbenhub Motor
-300 l: Kraftstofftank; Tankinhalt; Kraftstofftankinhalt; Hydrauliköltank
-6.7 l: Hubraum; Motorhubraum
-0.3 m³: Kraftstofftank; Tankinhalt; Kraftstofftankinhalt; Hydrauliköltank
-25 MPa: Speisedruck; Bremsdruck; Vorsteuerdruck; Druck der Bremsanlage
-400 kPa: Reifendruck; Reifenluftdruck; Bodendruck
-100 l/min: Fördermenge Lüfterpumpe; Fördermenge Bremspumpe; Fördermenge Zusatzsteuerkreis; Fördermenge Speisepumpe
-12 s: Vorglühzeit
-8 s: Beschleunigungszeit; Ausfahren Teleskop
-3500 kg: Nutzlast; Nutzlast mit Palettengabel; Nutzlast Palettengabel; Hubkraft bei max. Höhe
-7000 kg: Transportgewicht; Achslast vorn; Achslast hinten; Gewicht ohne Schaufel
-900 kg: Zusatzgewicht; Änderung des Einsatzgewichts; Reifenfüllung; Gewicht der Gabel
-120 kN: Hubkraft; Hubkraft am Boden; Haltekraft; Achskraft
-25 km/h: Geschwindigkeit 2. Gang; 3. Gang; Fahrgeschwindigkeit 1. Gang; Rückwärtsgang
-20 km/h: Windgeschwindigkeit; Kriechgang
-40 °: Steigfähigkeit; Böschungswinkel; Böschungswinkel hinten; Überhangwinkel
-30 °: Böschungswinkel vorn; Max. Steigung; Auffahrwinkel; Rampenwinkel
-2500 mm: Breite Kotflügel; Breite über Kotflügel; Breite über Spiegel; Kabinenbreite
-3300 mm: Höhe Motorhaube; Höhe Rundumleuchte; Stapelhöhe; Höhe über Motorhaube
-1200 mm: Zinkenlänge; Gabelzinkenlänge; Reichweite am Boden; Reichweite Gabeln
-6000 mm: Wendekreis; Wendekreisdurchmesser; Innerer Wenderadius; Wenderadius innen
-80 kW: Leistung Starter; Leistung Lichtmaschine; Elektromotorleistung; Kühlleistung
-1.5 kNm: Drehmoment; Max. Drehmoment
@excavator
Boom Cylinder Stroke: Kolbenhub Auslegerzylinder
Boom Cylinder Bore: Auslegerzylinder Bohrung
Boom Cylinder Rod Diameter: Kolbenstangen-Ø Auslegerzylinder
Arm Cylinder Stroke: Löffelstielzylinder Hub
Arm Cylinder Bore: Löffelstielzylinder Kolben-Ø
Arm Cylinder Rod Diameter: Löffelstielzylinder Stangen-Ø
Bucket Cylinder Stroke: Tieflöffelzylinder Hub
Bucket Cylinder Bore: Tieflöffelzylinder Bohrung
Bucket Cylinder Rod Diameter: Löffelzylinder Kolbenstange
Adjust Cylinder Stroke: Verstellauslegerzylinder Hub
Adjust Cylinder Bore: Verstellzylinder Bohrung
Blade Cylinder Stroke: Planierschildzylinder Hub
Blade Cylinder Bore: Planierschildzylinder Bohrung
Main Relief Pressure: Druckbegrenzungsventil Arbeitsausrüstung
Swing Relief Pressure: Max. Betriebsdruck Schwenkwerk
Travel Relief Pressure: Max. Betriebsdruck Fahrwerk
Main Pump Flow: Max. Fördermenge Arbeitspumpen
Swing Speed: Drehgeschwindigkeit Oberwagen
Swing Torque: Drehmoment Schwenkwerk
Maximum Travel Speed: Fahrgeschwindigkeit Schnellgang
Travel Speed Low: Fahrgeschwindigkeit Stufe 1 langsam
Drawbar Pull: Max. Zughakenkraft
Operating Weight: Betriebsgewicht inkl. Kabine und Tieflöffel
Counterweight: Gewicht des Kontergewichts
Bucket Weight: Gewicht Tieflöffel
Bucket Capacity: Löffelinhalt (SAE, gehäuft)
Bucket Width: Löffelbreite mit Seitenschneidern
Bucket Tip Radius: Löffelspitzenradius
Boom Length: Länge Monoblockausleger
Arm Length: Stiellänge Standard
Maximum Digging Depth: Maximale Grabtiefe
Maximum Digging Depth 2.44 m Level Bottom: Grabtiefe bei waagerechter Sohle 2440 mm
Maximum Vertical Wall Digging Depth: Max. Grabtiefe bei senkrechter Wand
Maximum Digging Height: Max. Höhe Löffelzahn
Maximum Dumping Height: Max. Ausschütthöhe
Minimum Dumping Height: Minimale Ausschütthöhe
Maximum Reach: Maximale Reichweite
Maximum Reach at Ground Line: Max. Reichweite auf Bodenniveau
Minimum Swing Radius: Minimaler Schwenkradius Ausleger
Tail Swing Radius: Schwenkradius des Oberwagens hinten
Overall Length: Gesamtlänge in Transportstellung
Overall Width: Gesamtbreite mit 600 mm Bodenplatten
Overall Height: Höhe Ausleger in Transportstellung
Cab Height: Gesamthöhe bis Oberkante Kabine
Height to Handrail: Höhe bis Oberkante Geländer
Upperstructure Width: Gesamtbreite des Oberwagens
Track Length: Gesamtlänge Unterwagen
Track Length on Ground: Mitte Leitrad - Mitte Turas
Track Gauge: Mitte Kette - Mitte Kette
Shoe Width: Breite Dreistegplatten
Track Height: Höhe Kettenlaufwerk
Ground Clearance: Bodenfreiheit unter Unterwagen
Counterweight Clearance: Bodenfreiheit unter Kontergewicht
Bucket Digging Force: Max. Losbrechkraft Löffelzylinder
Arm Digging Force: Max. Reißkraft Stielzylinder
Track Shoes Each Side: Anzahl Bodenplatten pro Kette
Track Rollers Each Side: Anzahl der Laufrollen je Seite
Carrier Rollers Each Side: Anzahl der Tragrollen je Seite
Blade Width: Abstützplanierschild Breite
Blade Height: Höhe des Planierschilds
Blade Lift Height: Max. Hub des Planierschilds über Boden
Blade Digging Depth: Planierschild max. Absenktiefe
Boom Swing Angle Left: Schwenkwinkel des Auslegers nach links
Boom Swing Angle Right: Schwenkwinkel des Auslegers nach rechts
Ground Pressure: Bodendruck mit 600 mm Bodenplatten
Net Power: Motorleistung nach ISO 9249
Gross Power: Motorleistung nach ISO 14396
Engine Power: Motorleistung bei 1800 min-1
-105 mm: Bohrung; Bohrung [Motor]; Kolbenhub [Motor]; Stegabstand
-120 kN: Hubkraft; Losbrechkraft mit Power Boost; Hubkraft am Boden; Bremskraft
-300 l: Kraftstofftank; Tankinhalt; Hydrauliköltank; Hydrauliksystem
-0.3 m³: Kraftstofftank; Tankinhalt; Hydrauliköltank; Hydrauliksystem
-25 MPa: Vorsteuerdruck; Vorsteuerkreis; Druck Vorsteuerpumpe; Steuerdruck
-100 L/min: Fördermenge Vorsteuerpumpe; Zusatzhydraulik; Fördermenge Zusatzhydraulik; Fördermenge Hammer
-1800 rpm: Nenndrehzahl; Motordrehzahl
-10 rpm: Lüfterdrehzahl
-0.5 kNm: Motordrehmoment
-100 kNm: Fahrmoment; Antriebsdrehmoment Fahren
-3 km/h: Mittlere Fahrgeschwindigkeit; Fahrgeschwindigkeit mittel
-3500 kg: Transportgewicht; Tragfähigkeit; Hubkraft bei 6 m; Gewicht Ausleger
-3000 mm: Breite mit Laufsteg; Höhe über Motorhaube; Motorhaubenhöhe; Höhe Auspuff
-1000 mm: Drehkranzhöhe; Breite Fußleiste; Versatz; Auslegerversatz
-600 mm: Teilung; Abstand der Laufrollen; Schnellwechslerbreite; Stiel Breite
-8000 mm: Reichweite mit Greifer; Hakenhöhe; Max. Schwenkradius; Max. Höhe bei min. Schwenkradius
-35 °: Steigfähigkeit; Löffeldrehwinkel; Böschungswinkel; Löffelöffnungswinkel
-60 kW: Leistung Lichtmaschine; Starterleistung; Kühlleistung; Leistungsaufnahme
@backhoe_loader
Loader Lift Cylinder Stroke: Hubzylinder Frontlader Hub
Loader Bucket Cylinder Stroke: Schaufelkippzylinder Hub
Boom Cylinder Stroke: Auslegerzylinder Hub
Dipper Cylinder Stroke: Löffelstielzylinder Hub
Backhoe Bucket Cylinder Stroke: Tieflöffelzylinder Hub
Swing Cylinder Stroke: Schwenkwerkszylinder Hub
Boom Cylinder Bore: Auslegerzylinder Bohrung
Swing Cylinder Bore: Schwenkzylinder Kolben-Ø
Operating Weight: Einsatzgewicht mit Standardausrüstung
Main Relief Pressure: Hauptdruckbegrenzungsventil
Main Pump Flow: Hydraulikpumpe Förderleistung
Maximum Travel Speed: Fahrgeschwindigkeit Straße
Overall Length: Gesamtlänge Transportstellung
Overall Height: Gesamthöhe in Transportstellung
Overall Width: Breite ohne Schaufel
Wheelbase: Achsabstand
Ground Clearance: Kleinste Bodenfreiheit
Turning Radius: Wenderadius über Reifen
Loader Hinge Pin Height: Max. Höhe bis Schaufelgelenk
Loader Dump Height: Schütthöhe Frontschaufel
Loader Dump Reach: Reichweite bei max. Ausschütthöhe
Loader Dump Angle: Auskippwinkel bei max. Höhe
Loader Rollback Angle: Ankippwinkel Bodenniveau
Loader Digging Depth: Schürftiefe Frontschaufel
Loader Breakout Force: Reißkraft am Schaufelzylinder
Loader Bucket Width: Gesamtbreite mit Schaufel
Loader Bucket Capacity: Schaufelinhalt Frontlader
Loader Raise Time: Hubzeit Lader
Loader Lower Time: Senkzeit Lader
Loader Dump Time: Schaufel auskippen
Loader Lift Arm Breakout Force: Losbrechkraft Hubzylinder
Loader Lift Capacity: Max. Hubkraft bei max. Höhe
Maximum Digging Depth: Grabtiefe Heckbagger
Maximum Reach at Ground Line: Reichweite auf Bodenniveau (ab Schwenkachse)
Backhoe Loading Height: Ausschütthöhe Heckbagger
Backhoe Operating Height: Arbeitshöhe Heckbagger
Backhoe Swing Arc: Schwenkbereich Heckbagger
Backhoe Bucket Rotation: Drehwinkel des Löffels
Bucket Digging Force: Grabkraft Löffelzylinder
Dipper Digging Force: Losbrechkraft Löffelstiel
Swing Pivot to Rear Axle: Mitte Hinterachse bis Schwenkzapfen
Kingpost Clearance: Bodenfreiheit unter Schwenkbock
Stabilizer Spread: Breite über Abstützungen ausgefahren
Backhoe Bucket Capacity: Löffelinhalt Heckbagger
Steering Angle: Maximaler Radeinschlag
Front Axle Oscillation: Pendelwinkel Vorderachse
Tyre Diameter: Reifendurchmesser
Net Power: Nettoleistung (SAE J1349)
Gross Power: Bruttoleistung (ISO 14396)
Engine Power: Motorleistung
-120 mm: Kolbenhub [Motor]; Motor Bohrung; Hub Motor
-0.15 m³: Kraftstofftank; Hydrauliktank; Tankinhalt
-21 MPa: Bremsdruck; Lenkdruck; Druck Zusatzkreis; Hammerkreis Druck
-90 L/min: Fördermenge Zusatzhydraulik; Durchfluss Hammerkreis; Fördermenge Lenkpumpe; Zusatzkreis Fördermenge
-12 km/h: 2. Gang; Geschwindigkeit 1. Gang; 1. Gang vorwärts; Rückwärtsgang
-3500 kg: Achslast vorn; Achslast hinten; Tragkraft Ausleger; Hubkraft Stiel
-2200 mm: Breite Löffel; Spurweite vorn; Breite über Spiegel; Transportbreite Abstützungen
-4500 mm: Grabtiefe Teleskopstiel ausgefahren; Max. Grabtiefe mit Teleskopstiel ausgefahren; Wendekreis
-350 mm: Bodenfreiheit Abstützungen; Bodenfreiheit unter Stützen
-50 kN: Zugkraft; Max. Zugkraft; Hubkraft
-45 °: Böschungswinkel hinten; Böschungswinkel; Steigfähigkeit; Rampenwinkel
-5 kW: Lichtmaschine; Starter
@skid_steer
Lift Cylinder Stroke: Hubarmzylinder Hub
Lift Cylinder Bore: Hubarmzylinder Bohrung
Tilt Cylinder Stroke: Schaufelzylinder Hub
Tilt Cylinder Bore: Schaufelkippzylinder Bohrung
Operating Weight: Gewicht betriebsbereit
Main Relief Pressure: Systemdruck an Schnellkupplungen
Main Pump Flow: Förderleistung Hydraulikpumpe
Maximum Travel Speed: Fahrgeschwindigkeit (hoher Bereich)
Overall Height: Höhe bis Oberkante Kabine
Overall Width: Fahrzeugbreite ohne Schaufel
Wheelbase: Achsabstand
Ground Clearance: Min. Bodenfreiheit
Tyre Diameter: Reifendurchmesser
Hinge Pin Height at Maximum Lift: Max. Hubhöhe bis Schaufeldrehpunkt
Dumping Clearance: Ausschütthöhe bei voller Auskippung
Dumping Reach: Reichweite bei max. Hub und Auskippen
Dump Angle at Maximum Lift: Auskippwinkel bei maximaler Höhe
Rack Back at Ground: Rückkippwinkel in Transportstellung
Digging Depth: Grabtiefe Schaufel
Breakout Force: Ausbrechkraft - Kippzylinder
Bucket Width: Gesamtbreite mit Schaufel
Bucket Capacity: Schaufelinhalt (gehäuft)
Raise Time: Hubarme anheben
Lower Time: Hubarme absenken
Dump Time: Schaufel auskippen
Rated Operating Capacity: Nutzlast (50 % der Kipplast)
Tipping Load: Kipplast nach ISO 14397-1
Length with Bucket: Gesamtlänge (mit Schaufel am Boden)
Length Without Attachment: Maschinenlänge ohne Anbaugerät
Turning Radius with Bucket: Vorderer Wenderadius mit Schaufel
Turning Radius Rear: Wenderadius hinten ab Mitte
Departure Angle: Hinterer Böschungswinkel
Operating Height Fully Raised: Gesamthöhe bei angehobener Schaufel
Lift Arm Breakout Force: Ausbrechkraft - Hubzylinder
Auxiliary Flow: Fördermenge Zusatzhydraulik Standard
Engine Power: Motorleistung
Net Power: Motorleistung netto
Gross Power: Motorleistung brutto
-100 mm: Kolbenhub [Motor]; Bohrung [Motor]; Motor Hub; Motorbohrung
-0.09 m³: Kraftstofftank; Tankinhalt; Hydrauliktank; Hydrauliksystem
-20 MPa: Speisedruck; Fahrantrieb Druck; Reifendruck; Druck Fahrhydraulik
-120 L/min: High-Flow; Hochleistungshydraulik; High Flow Fördermenge; Fahrpumpe Fördermenge
-1500 kg: Versandgewicht; Transportgewicht; Tragfähigkeit mit Gabeln; Nutzlast mit Zusatzgewicht
-2800 mm: Höhe Gabelzinken; Hubhöhe Gabel
-1500 mm: Länge Hubarm; Spurweite; Kabinenbreite; Höhe Sitz
-25 °: Böschungswinkel vorn; Steigfähigkeit; Rückkippwinkel bei max. Höhe; Rückkippwinkel bei voller Hubhöhe
-20 kN: Zugkraft; Max. Zugkraft; Schubkraft
-3 kW: Lichtmaschine; Starter; Anlasser
-8 km/h: Rückwärts; Fahrgeschwindigkeit niedriger Bereich; Fahrgeschwindigkeit langsam
@dozer
Blade Lift Cylinder Stroke: Schild-Hubzylinder Hub
Blade Lift Cylinder Bore: Schildhubzylinder Bohrung
Blade Tilt Cylinder Stroke: Schildneigungszylinder Hub
Blade Tilt Cylinder Bore: Schildtiltzylinder Bohrung
Ripper Lift Cylinder Stroke: Heckaufreißer Hubzylinder Hub
Ripper Lift Cylinder Bore: Aufreißerhubzylinder Bohrung
Main Relief Pressure: Druckbegrenzung Arbeitshydraulik
Main Pump Flow: Fördermenge Arbeitshydraulik
Operating Weight: Einsatzgewicht mit Schild und Aufreißer
Maximum Travel Speed: Max. Fahrgeschwindigkeit vorwärts
Maximum Reverse Speed: Max. Fahrgeschwindigkeit rückwärts
Shipping Weight: Transportgewicht ohne Schild
Blade Weight: Planierausrüstung Gewicht
Blade Capacity: Schildkapazität nach SAE J1265
Blade Width: Schildbreite (über Eckmesser)
Blade Height: Planierschildhöhe
Blade Digging Depth: Einstechtiefe unter Planum
Blade Lift Height: Max. Schildhub über Boden
Maximum Blade Tilt: Max. Querneigung Schild
Blade Tilt Angle: Querneigungswinkel Schild
Blade Pitch Adjustment: Schildschnittwinkelverstellung
Blade Angle: Schwenkwinkel (beidseitig)
Length Without Blade: Länge Grundgerät ohne Anbauten
Length with Blade: Gesamtlänge mit Planierschild
Width over Trunnions: Breite über Schubarmlager
Overall Height: Höhe bis Kabinenoberkante
Ground Clearance: Kleinste Bodenfreiheit
Track Gauge: Kettenmittenabstand
Shoe Width: Breite der Bodenplatten
Width over Tracks: Maschinenbreite ohne Schild
Track Length on Ground: Länge der Kette auf dem Boden
Track Pitch: Kettenglied Teilung
Grouser Height: Steghöhe Bodenplatten
Track Shoes Each Side: Anzahl der Bodenplatten je Seite
Track Rollers Each Side: Anzahl Laufrollen je Seite
Carrier Rollers Each Side: Stützrollen je Seite
Ground Pressure: Spezifischer Bodendruck
Drawbar Pull: Maximale Zughakenkraft
Ripper Penetration: Max. Eindringtiefe Aufreißer
Ripper Lift Height: Freiraum unter Aufreißerzahn angehoben
Net Power: Motorleistung netto (ISO 9249)
Gross Power: Bruttoleistung (SAE J1995)
Engine Power: Motorleistung
-140 mm: Kolbenhub [Motor]; Bohrung; Bohrung x Hub; Zylinderhub Motor
-0.4 m³: Kraftstofftank; Tankinhalt; Hydrauliktank; Kühlsystem
-24 MPa: Lenkdruck; Fahrantrieb max. Druck; Speisedruck; Druck Fahrhydraulik
-200 L/min: Fördermenge Lenkpumpe; Lüfterpumpe Fördermenge; Speisepumpe Fördermenge; Fahrpumpe Fördermenge
-6 km/h: 2. Gang; Fahrgeschwindigkeit 1. Gang; 1. Gang vorwärts; 2. Gang rückwärts
-2500 kg: Gewicht Aufreißer; Aufreißergewicht; Gewicht Winde; Gewicht Kontergewicht
-1000 mm: Schneidmesserhöhe; Höhe Zughaken; Höhe Anhängekupplung; Zahnabstand
-2600 mm: Höhe Motorhaube; Höhe Auspuff; Höhe bis Auspuff; Balkenbreite Aufreißer
-5000 mm: Länge mit Aufreißer; Länge mit Heckaufreißer; Wenderadius; Länge mit Winde
-25 °: Steigfähigkeit; Böschungswinkel; Pendelung; Max. Querneigung Maschine
-90 kN: Schildkraft; Eindringkraft Aufreißer; Ausreißkraft Aufreißer; Ausbrechkraft Aufreißer
-25 kW: Lüfterleistung
@grader
Blade Lift Cylinder Stroke: Schar-Hubzylinder Hub
Blade Lift Cylinder Bore: Scharhubzylinder Bohrung
Articulation Cylinder Stroke: Rahmenknickzylinder Hub
Side Shift Cylinder Stroke: Schar-Seitenverschiebezylinder Hub
Operating Weight: Betriebsgewicht typisch ausgerüstet
Main Relief Pressure: Max. Betriebsdruck
Main Pump Flow: Max. Fördermenge
Maximum Travel Speed: Max. Fahrgeschwindigkeit vorwärts
Maximum Reverse Speed: Höchstgeschwindigkeit rückwärts
Steering Angle: Lenkeinschlagwinkel links/rechts
Articulation Angle: Knickwinkel links/rechts
Front Axle Oscillation: Vorderachse Pendelung gesamt
Turning Radius: Wenderadius (Außenkante Vorderreifen)
Wheel Lean Angle: Radneigung links/rechts
Moldboard Length: Breite der Planierschar
Moldboard Height: Höhe der Schar
Moldboard Thickness: Materialstärke Schar
Moldboard Arc Radius: Krümmungsradius der Schar
Throat Clearance: Abstand Schar - Drehkranz
Circle Rotation: Schwenkbereich Drehkranz
Circle Diameter: Außendurchmesser Drehkranz
Blade Lift Above Ground: Bodenfreiheit Schar angehoben
Depth of Cut: Schnitttiefe Schar
Blade Side Shift Left: Schar-Seitenverschiebung nach links
Blade Side Shift Right: Seitenverschiebung der Schar nach rechts
Shoulder Reach: Max. seitliche Ausladung außerhalb der Reifen
Bank Cut Angle: Max. Böschungsschneidwinkel
Blade Tip Angle Forward: Schnittwinkelverstellung nach vorn
Blade Tip Angle Backward: Schnittwinkelverstellung nach hinten
Blade Pull: Max. Schubkraft an der Schar
Blade Down Pressure: Max. Scharanpressdruck
Height to Top of Cylinders: Höhe bis Oberkante Hubzylinder
Front Axle Height: Höhe bis Mitte Vorderachse
Tandem Axle Spacing: Achsabstand Tandemachse
Front Axle to Articulation: Abstand Vorderachse - Knickgelenk
Rear Axle to Articulation: Mitte Hinterachse bis Knickgelenk
Front Axle to Moldboard: Scharabstand zur Vorderachse
Tire Centerline Width: Spurweite Reifenmitte
Overall Height: Höhe über ROPS-Kabine
Overall Width: Breite über Vorderreifen
Overall Length: Länge Grundmaschine
Ground Clearance: Bodenfreiheit unter Hinterachse
Wheelbase: Mitte Vorderachse bis Mitte Tandem
Ripper Penetration: Eindringtiefe Heckaufreißer
Net Power: Nettoleistung netto
Gross Power: Motorleistung brutto
Engine Power: Motorleistung
-130 mm: Kolbenhub [Motor]; Bohrung [Motor]; Bohrung x Hub
-0.4 m³: Kraftstofftank; Tankinhalt; Hydrauliktank
-24 MPa: Lenkdruck; Bremsdruck; Speisedruck; Vorsteuerdruck
-20 km/h: 5. Gang; 3. Gang vorwärts; 4. Gang rückwärts
-4500 kg: Achslast vorn; Achslast hinten; Vorderachslast; Gewicht auf Vorderachse
-300 mm: Frontschildhöhe; Höhe Schneidmesser; Schneidmesserbreite; Aufreißerzahnabstand
-2500 mm: Breite Frontschild; Breite Aufreißer; Frontschildbreite; Kabinenbreite
-20 °: Pendelung Tandem; Tandempendelung; Tandemachspendelung; Steigfähigkeit
-80 kN: Eindringkraft Aufreißer; Reißkraft Aufreißer; Zugkraft am Haken; Eindringkraft
-9500 mm: Länge mit Heckaufreißer; Länge mit Frontschild; Gesamtlänge mit Heckaufreißer; Wendekreis
@forklift
Lift Cylinder Stroke: Haupthubzylinder Hub
Free Lift Cylinder Stroke: Freihub-Zylinder Hub
Tilt Cylinder Stroke: Mastneigezylinder Hub
Tilt Cylinder Bore: Neigezylinder Bohrung
Steering Cylinder Stroke: Lenkzylinder Hub
Main Relief Pressure: Arbeitsdruck Hubhydraulik
Main Pump Flow: Fördermenge Hydraulikpumpe
Rated Capacity: Tragfähigkeit bei Lastschwerpunkt 500 mm
Load Center: Lastschwerpunktabstand (c)
Load Distance: Lastabstand, Mitte Antriebsachse bis Gabel
Operating Weight: Eigengewicht einschl. Batterie
Axle Load Front Laden: Achslast mit Last, Antriebsseite
Axle Load Front Unladen: Achslast ohne Last, Antriebsseite
Mast Tilt Forward: Neigung Hubgerüst/Gabelträger vor
Mast Tilt Backward: Neigung Hubgerüst/Gabelträger zurück
Lowered Mast Height: Höhe des Hubgerüstes, eingefahren
Free Lift Height: Normaler Freihub
Lift Height: Hubhöhe Oberkante Gabel
Extended Mast Height: Größte Höhe Hubgerüst ausgefahren
Overhead Guard Height: Höhe bis Oberkante Fahrerschutzdach
Seat Height: Sitzhöhe bezogen auf SIP
Coupling Height: Höhe Anhängerkupplung
Length to Fork Face: Länge einschließlich Gabelrücken l2
Overall Length: Gesamtlänge inkl. Gabel
Overall Width: Breite über Antriebsräder
Wheelbase: Achsabstand y
Ground Clearance: Bodenfreiheit mit Last Mitte Radstand
Turning Radius: Kleinster äußerer Wenderadius
Front Tread: Spurweite Antriebsachse
Rear Tread: Spurweite Hinterräder
Ground Clearance Below Mast: Kleinste Bodenfreiheit unter Hubgerüst mit Last
Fork Length: Länge der Gabelzinken l
Fork Width: Gabelzinken Breite
Fork Thickness: Gabelzinken Dicke
Fork Carriage Width: Breite des Gabelträgers
Aisle Width: Arbeitsgangbreite bei Palette 1000x1200 quer Ast
Travel Speed Laden: Fahrgeschwindigkeit vorwärts mit Last
Travel Speed Unladen: Fahrgeschwindigkeit vorwärts ohne Last
Lift Speed Laden: Hubgeschwindigkeit mit Nennlast
Lift Speed Unladen: Hubgeschwindigkeit, ohne Last
Lowering Speed Laden: Senkgeschwindigkeit mit Nennlast
Lowering Speed Unladen: Absenkgeschwindigkeit ohne Last
Drawbar Pull: Maximale Zugkraft mit Last
Tyre Diameter: Reifendurchmesser
Engine Power: Motorleistung bei Nenndrehzahl
Net Power: Motorleistung nach ISO 9249
Gross Power: Motorleistung brutto
-12 kW: Fahrmotor; Hubmotor; Leistung Hubmotor; Leistung Fahrmotor
-1500 kg: Achslast mit Last hinten; Achslast ohne Last hinten; Achslast hinten mit Last; Achslast hinten, ohne Last
-1500 mm: Breite Batterie; Batterieraum Länge; Arbeitsgangbreite Palette 800 x 1200 längs; Gabelaußenabstand
-3200 mm: Arbeitsgangbreite bei Palette 800 x 1200 längs; Gangbreite Palette 800 × 1200 längs; Palettenlänge
-2 kN: Zugkraft ohne Last; Max. Zugkraft ohne Last; Zugkraft ohne Last S2 60 min
-8 km/h: Windgeschwindigkeit; Fahrgeschwindigkeit rückwärts mit Last; Schleichfahrt
-0.3 m/s: Neigegeschwindigkeit; Seitenschubgeschwindigkeit
-15 %: Steigfähigkeit mit Last; Max. Steigfähigkeit
-14 MPa: Arbeitsdruck für Anbaugeräte; Arbeitsdruck Anbaugeräte; Betriebsdruck für Anbaugeräte; Reifendruck
-40 L/min: Ölmenge für Anbaugeräte; Ölstrom für Anbaugeräte; Ölmenge Anbaugeräte; Volumenstrom für Anbaugeräte
-100 mm: Bohrung [Motor]; Hub [Motor]; Motorhub; Kolbenhub Motor
@mobile_crane
Luffing Cylinder Stroke: Auslegerwippzylinder Hub
Luffing Cylinder Bore: Kolbendurchmesser Wippzylinder
Telescoping Cylinder Stroke: Teleskopierzylinder Hub
Outrigger Jack Cylinder Stroke: Vertikalstützzylinder Hub
Main Relief Pressure: Max. Arbeitsdruck Kranhydraulik
Main Pump Flow: Max. Fördermenge
Maximum Lifting Capacity: Maximale Tragfähigkeit
Radius at Maximum Capacity: Ausladung bei maximaler Tragkraft
Maximum Working Radius: Max. Arbeitsausladung
Boom Length Retracted: Länge Teleskopausleger eingefahren
Boom Length Extended: Auslegerlänge ausgeschoben
Boom Sections: Anzahl Auslegerelemente
Boom Telescoping Time: Teleskopiergeschwindigkeit
Boom Luffing Time: Auslegeraufrichtzeit
Boom Angle Maximum: Auslegerstellung max.
Boom Angle Minimum: Kleinster Auslegerwinkel
Jib Length: Doppelklappspitze Länge
Jib Offset Angle: Klappspitze, Abwinkelung
Maximum Tip Height: Max. Rollenkopfhöhe
Slewing Speed: Drehgeschwindigkeit Oberwagen
Main Winch Line Speed: Seilgeschwindigkeit im einfachen Strang
Main Winch Line Pull: Seilzug einfacher Strang
Hoist Rope Diameter: Seildurchmesser Hauptwinde
Outrigger Spread Lateral: Abstützbreite voll ausgefahren
Outrigger Spread Longitudinal: Abstützbasis (Länge)
Counterweight: Maximales Kontergewicht
Tail Swing Radius: Schwenkradius Gegengewicht
Operating Weight: Gesamtgewicht im Straßentransport
Axle Load: Achslast pro Achse
Maximum Travel Speed: Höchstgeschwindigkeit Straße
Overall Length: Gesamtlänge in Fahrstellung
Overall Width: Breite über alles
Overall Height: Gesamthöhe in Fahrstellung
Ground Clearance: Min. Bodenfreiheit
Turning Radius: Wenderadius bei Allradlenkung
Approach Angle: Vorderer Böschungswinkel
Departure Angle: Hinterer Böschungswinkel
Engine Power: Motorleistung Unterwagen
-200 kW: Leistung Oberwagenmotor; Motorleistung Oberwagen; Oberwagenmotor; Kranmotor
-12000 kg: Hakenflasche Tragfähigkeit; Traglast mit Klappspitze; Traglast Spitze; Anhängelast
-120 m/min: Seilgeschwindigkeit Hubwerk 2; Seilgeschwindigkeit Hilfswinde; Hubwerk 2; Hilfshubwerk
-60 kN: Seilzug Hubwerk 2; Seilzug Hilfswinde; Bruchkraft; Mindestbruchkraft
-210 mm: Motor Bohrung; Kolbenhub [Motor]; Abstützteller; Tellerdurchmesser
-4500 mm: Radstand; Achsabstand; Abstützbreite eingefahren; Abstützbasis halb ausgefahren
-20 °: Steigfähigkeit; Lenkeinschlag; Klappspitze min. Abwinkelung
-30 m: Hubhöhe bei max. Radius; Seillänge; Hubseillänge; Windgeschwindigkeit
-25 m: Seillänge; Hubseil Länge
-60 s: Abstützzeit; Abstützen; Drehen; Einteleskopieren
-30 km/h: Kriechgang; Rückwärtsgang; Geschwindigkeit rückwärts
-24 MPa: Bremsdruck; Lenkdruck; Drehwerk Druck; Schwenkwerk Betriebsdruck
-200 L/min: Fördermenge Drehwerk; Lenkpumpe Fördermenge; Fördermenge Schwenkwerk
@rigid_dump_truck
Hoist Cylinder Stroke: Kipphydraulikzylinder Hub
Hoist Cylinder Bore: Kippzylinder Bohrung
Steering Cylinder Stroke: Lenkzylinder Hub
Main Relief Pressure: Druckbegrenzung Kipphydraulik
Main Pump Flow: Fördermenge Kipphydraulik
Rated Payload: Zulässige Nutzlast
Empty Weight: Betriebsgewicht unbeladen
Gross Weight: Maximales Betriebsgewicht beladen
Body Capacity Heaped: Muldeninhalt gehäuft SAE
Body Capacity Struck: Muldeninhalt gestrichen voll
Body Dump Angle: Kippwinkel der Mulde
Body Raise Time: Kippzeit mit Last
Body Lower Time: Mulde absenken Schwimmstellung
Body Weight: Standardmulde Gewicht
Chassis Weight: Fahrgestell mit Kippzylinder
Maximum Travel Speed: Höchstgeschwindigkeit (beladen)
Maximum Reverse Speed: Fahrgeschwindigkeit rückwärts max.
Steering Angle: Max. Lenkeinschlag
Turning Radius: Wenderadius über Vorderreifen
Overall Length: Länge über alles
Overall Width: Breite Hinterachse Reifenaußenkante
Overall Height: Höhe bis Oberkante ROPS
Wheelbase: Achsabstand
Front Tread: Mittenabstand Vorderreifen
Rear Tread: Mittenabstand hintere Zwillingsreifen
Ground Clearance: Min. Bodenfreiheit
Tyre Diameter: Reifendurchmesser
Body Raised Height: Gesamthöhe mit angehobener Mulde
Loading Height: Höhe Muldenkante
Dump Clearance: Bodenfreiheit bei gekippter Mulde
Body Length Inside: Innere Muldenlänge
Body Width Inside: Innere Muldenbreite
Body Width Outside: Äußere Muldenbreite
Body Depth Inside: Max. Innentiefe Mulde
Rear Overhang: Hinterachse bis hintere Muldenkante
Operating Width: Gesamtbreite mit Spiegeln
Canopy Width: Breite des Muldenschutzdaches
Front Canopy Height: Höhe Oberkante Schutzdach
Body Length Overall: Muldenlänge gesamt
Rear Axle Clearance: Bodenfreiheit unter Hinterachse
Engine Guard Clearance: Bodenfreiheit unter Motorschutz
Engine Power: Motorleistung
Net Power: Nettoleistung (SAE J1349)
Gross Power: Bruttoleistung (SAE J1995)
-159 mm: Kolbenhub [Motor]; Bohrung; Reifenprofiltiefe; Scheibendurchmesser
-0.7 m³: Kraftstofftank; Tankinhalt; Hydrauliktank; Ölwanne
-21 MPa: Lenkdruck; Bremsdruck; Vorsteuerdruck; Druckbegrenzung Lenkung
-300 L/min: Fördermenge Lenkung; Bremskühlung Fördermenge; Lenkpumpe; Fördermenge Lenkpumpe
-20 km/h: 1. Gang; Geschwindigkeit 3. Gang; 3. Gang
-40000 kg: Achslast vorn; Achslast hinten; Gewicht auf Vorderachse; Gewichtsverteilung vorn leer
-80 m³: Muldeninhalt gehäuft 3:1
-3500 mm: Wendekreis; Breite Kabine; Höhe Motorhaube; Überhang vorn
-25 °: Steigfähigkeit; Pendelwinkel
-600 mm: Innenabstand Zwillingsreifen; Federweg; Federweg vorn; Höhe Trittstufe
-400 kN: Zugkraft; Max. Zugkraft; Bremskraft
-25 kW: Lüfterleistung; Lichtmaschine; Retarderleistung
@articulated_dump_truck
Hoist Cylinder Stroke: Muldenkippzylinder Hub
Steering Cylinder Stroke: Knicklenkzylinder Hub
Main Relief Pressure: Betriebsdruck Kipphydraulik
Main Pump Flow: Fördermenge je Pumpe
Rated Payload: Zulässige Nutzlast
Empty Weight: Betriebsgewicht unbeladen
Gross Weight: Maximales Einsatzgewicht beladen
Body Capacity Heaped: Muldenkapazität gehäuft
Body Capacity Struck: Muldenkapazität gestrichen
Body Capacity Heaped with Tailgate: Muldenvolumen gehäuft inkl. Heckklappe
Body Capacity Struck with Tailgate: Muldenvolumen gestrichen inkl. Heckklappe
Body Dump Angle: Muldenkippwinkel
Body Raise Time: Hubzeit (mit Last)
Body Lower Time: Muldensenkzeit
Maximum Travel Speed: Höchstgeschwindigkeit vorwärts
Maximum Reverse Speed: Höchstgeschwindigkeit rückwärts
Articulation Angle: Lenkeinschlag beidseitig
Turning Radius: Wenderadius über Reifen
Overall Length: Länge über alles
Overall Width: Breite über Reifen
Overall Height: Höhe über Kabine
Body Raised Height: Gesamthöhe bei gekippter Mulde
Loading Height: Höhe Muldenkante
Dump Clearance: Bodenfreiheit bei gekippter Mulde
Body Length Inside: Muldenlänge innen
Body Width Inside: Muldenbreite innen
Body Width Outside: Muldenbreite außen
Body Depth Inside: Muldentiefe innen
Rear Overhang: Hinterachse bis Muldenende
Front Axle to Bogie: Mitte Vorderachse bis Mitte Tandemachse
Bogie Axle Spacing: Abstand Mittelachse - Hinterachse
Front Tread: Spurweite Vorderachse
Rear Tread: Spurweite Hinterachse
Ground Clearance: Bodenfreiheit Knickgelenk
Front Overhang: Mitte Vorderachse bis Fahrzeugfront
Approach Angle: Vorderer Böschungswinkel
Engine Power: Motorleistung
Net Power: Nettoleistung SAE J1349
Gross Power: Bruttoleistung SAE J1995
-135 mm: Kolbenhub [Motor]; Bohrung
-0.4 m³: Kraftstofftank; Tankinhalt; Hydrauliktank
-20 MPa: Lenkdruck; Bremsdruck; Druck Lenksystem
-200 L/min: Fördermenge Lenkpumpe; Lenkpumpe; Lenkung Fördermenge
-15 km/h: 2. Gang; Geschwindigkeit 3. Gang; 2. Gang rückwärts
-15000 kg: Achslast vorn; Vorderachse leer; Hinterachse beladen; Mittelachse beladen
-3000 mm: Wenderadius innen; Innerer Wenderadius; Höhe Motorhaube; Breite Heckklappe
-35 °: Pendelwinkel; Steigfähigkeit; Böschungswinkel hinten; Abfahrwinkel
-25 kW: Lüfterleistung; Retarderleistung; Lichtmaschine
"""
BY_TYPE = {part.partition("\n")[0]: part.splitlines()[1:] for part in LABELS.split("@") if part}


@pytest.mark.parametrize("equipment_type", BY_TYPE)
def test_labels_are_taken_for_what_they_mean(equipment_type: str) -> None:
    lines = (line.partition(": ") for line in BY_TYPE[equipment_type])
    rows = [(head.removeprefix("-"), label, "") for head, _, labels in lines for label in labels.split("; ")]
    assert misread(equipment_type, rows) == []
